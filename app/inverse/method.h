// SPDX-License-Identifier: Apache-2.0
// A way to find the facets' slopes: what a run needs of it, whichever it is.
#pragma once
#include "inverse/assign/cost.h"
#include "inverse/facets/solid.h"
#include "job/job.h"
#include "mpi/rank_context.h"

namespace nephroid::inverse {

class Method {
public:
  virtual ~Method() = default;
  /// Does a short piece of work, some milliseconds. It is not called once finished() is true.
  virtual void advance() = 0;
  /// Whether more steps would gain nothing.
  virtual bool finished() const = 0;
  virtual std::int64_t steps() const = 0;   ///< completed steps: sweeps, moves
  virtual std::int64_t most() const = 0;    ///< how many steps it takes where the preset has no other stop
  virtual double fraction_done() const = 0; ///< the part done of the step in hand
  virtual std::uint64_t tried() const = 0;  ///< facets tried, in all steps
  virtual job::Units units() const = 0;

  virtual const std::vector<glm::dvec2>& slopes() const = 0; ///< the slopes so far
  virtual std::vector<double> heights() const = 0;           ///< z of the middles of the facets with these slopes
  virtual const std::vector<double>& light(std::size_t receiver) const = 0; ///< these slopes' light, by footprints
  virtual std::vector<Cost> costs() const = 0;                              ///< the costs of that light
  virtual Solid solid() const = 0;                                          ///< a solid whose facets have these slopes
  /// Takes on the layout's new distances, offsets or weights, or new targets. Facets keep their slopes, and the search
  /// goes on from them. It is called only where adoptable() allows it.
  virtual void relight() {}
  /// Adds the figures that this method alone has. The job adds the cost over steps and seconds.
  virtual void show(job::Snapshot&) const {}

  /// All that the method needs to go on with the same bits.
  virtual void serialize(Archive& archive) = 0;
};

} // namespace nephroid::inverse
