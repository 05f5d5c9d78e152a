// SPDX-License-Identifier: Apache-2.0
// A way to find the facets' slopes: what a run needs of it, whichever it is.
#pragma once
#include "base/bytes.h"
#include "compute/compute.h"
#include "inverse/assign/cost.h"
#include "inverse/facets/solid.h"
#include "inverse/layout.h"
#include "job/job.h"
#include "mpi/rank_context.h"

#include <memory>

namespace nephroid::inverse {

class Method {
public:
  virtual ~Method() = default;
  /// A short piece of work, some milliseconds. Never called once finished() is true.
  virtual void advance() = 0;
  /// More steps would gain nothing.
  virtual bool finished() const = 0;
  virtual std::int64_t steps() const = 0;   ///< completed: sweeps, moves
  virtual std::int64_t most() const = 0;    ///< steps that it takes where the preset has no other stop
  virtual double fraction_done() const = 0; ///< of the slice in hand
  virtual std::uint64_t tried() const = 0;  ///< facets, of all steps
  virtual job::Units units() const = 0;

  virtual const std::vector<glm::dvec2>& slopes() const = 0; ///< as good as they are so far
  virtual std::vector<double> heights() const = 0;           ///< z of the facets' middles, whose slopes these are
  virtual const std::vector<double>& light(std::size_t receiver) const = 0; ///< of these slopes, by their footprints
  virtual std::vector<Cost> costs() const = 0;                              ///< of that light
  virtual Solid solid() const = 0;                                          ///< whose facets have these slopes
  /// The layout's distances, offsets or weights, or the targets, are other ones: facets keep their slopes, and the
  /// search goes on from them. Only where adoptable() says so.
  virtual void relight() {}
  /// Adds what this method alone has to tell. The job has the cost over steps and seconds.
  virtual void show(job::Snapshot&) const {}

  /// All that it needs to go on with the same bits.
  virtual void state(State& state) = 0;
};

/// As the preset says. The layout and the targets outlive it.
std::unique_ptr<Method> make_method(const preset::Preset& preset, const Layout& layout,
                                    const std::vector<Target>& targets, const mpi::RankContext& context);

} // namespace nephroid::inverse
