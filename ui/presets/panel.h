// SPDX-License-Identifier: Apache-2.0
// The panel "Presets": the shipped presets and the files that were opened lately, with a small picture each. They are
// searched, looked at and opened, by the mouse or by the keyboard alone.
#pragma once
#include "ui/presets/catalogue.h"
#include "ui/widgets/panel.h"

namespace nephroid::ui {

class PresetsPanel : public Panel {
public:
  static constexpr const char* title = "Presets";
  void draw(const Context& context) override;

  /// For tests. Widgets have places: a row by its name, "search", "engine", "engine:spectral", "newest", "open".
  const Catalogue& catalogue() const { return catalogue_; }
  std::vector<std::string> listed() const;
  const std::string& chosen() const { return chosen_; }
  const Thumbnails& thumbnails() const { return thumbnails_; }

private:
  void draw_top();
  void draw_list(const Context& context, float height);
  void draw_row(const Context& context, const CatalogueEntry& entry);
  void draw_details(const Context& context);
  void follow_keys(const Context& context);
  void open(const Context& context, const CatalogueEntry& entry) const;
  const CatalogueEntry* chosen_entry() const;

  Catalogue catalogue_;
  Thumbnails thumbnails_;
  CatalogueFilter filter_;
  std::vector<std::size_t> matches_;
  std::string chosen_;  ///< the file of the row that is marked
  bool reveal_ = false; ///< the marked row is to be brought into sight
  bool focused_ = false;
  bool typing_ = false; ///< in the search
  int page_ = 1;        ///< rows in sight
};

} // namespace nephroid::ui
