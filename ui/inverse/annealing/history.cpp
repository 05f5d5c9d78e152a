// SPDX-License-Identifier: Apache-2.0
#include "ui/inverse/annealing/history.h"

#include <algorithm>
#include <cmath>

namespace nephroid::ui {

HistoryLines history_lines(const job::Curve& curve, const HistoryLook& look)
{
  const auto found = std::find(curve.columns.begin(), curve.columns.end(), "seconds");
  const auto seconds = static_cast<std::size_t>(found - curve.columns.begin());
  const std::size_t over = look.seconds && found != curve.columns.end() ? seconds : 0;
  HistoryLines history{curve.name, curve.columns.at(over), {}};
  for (std::size_t column = 1; column < curve.columns.size(); ++column) {
    if (column == seconds) continue;
    HistoryLine line{curve.columns[column], {}, {}};
    for (const std::vector<double>& row : curve.rows) {
      if (!std::isfinite(row[over]) || !std::isfinite(row[column]) || (look.log && row[column] <= 0)) continue;
      line.x.push_back(row[over]);
      line.y.push_back(row[column]);
    }
    history.lines.push_back(std::move(line));
  }
  return history;
}

} // namespace nephroid::ui
