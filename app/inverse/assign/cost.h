// SPDX-License-Identifier: Apache-2.0
// How far light is from the picture that is wanted, as runs report it and the search lowers it; how unlike facets are.
#pragma once
#include "inverse/layout.h"

namespace nephroid::inverse {

/// T is the wanted light, Z the light that is there.
struct Cost {
  /// sqrt(sum (T / Tmax - Z / Zmax)^2 / cells), thesis (5.2), over the cells where T / Tmax + Z / Zmax > 0.01. By (5.3)
  /// every cell with any light counts, so that one stray ray in a dark cell lowers the cost.
  double cost = 0;
  double cost_all = 0; ///< the same over all cells
  double rel_l2 = 0;   ///< |T / sum T - Z / sum Z| / |T / sum T|
  double missed = 0;   ///< part of the light that falls beside the receiver
};

/// `sent` is the light that left the object, in the unit of z.
Cost cost_of(const Target& t, std::span<const double> z, double sent);

/// A cost for each target. `light` is [receiver][cell], with more at its end; `sent` is for each receiver.
std::vector<Cost> costs_of(const std::vector<Target>& targets, const std::vector<std::vector<double>>& light,
                           std::span<const double> sent);

Cost mean(std::span<const Cost> costs);

/// The weights of the pictures' squares. They are the layout's, scaled so that pictures of one weight count alike: a
/// cost is of light over its maximum, and a mean over the cells with light in them.
std::vector<double> picture_weights(const Layout& layout, const std::vector<Target>& targets);

/// What the search lowers: the sum of weight * (Z - T)^2 over receivers and cells, with as much wanted light as there
/// are facets. `light` is [receiver][cell], in units of facets that send all of theirs.
double weighted_squares(const std::vector<Target>& targets, std::span<const double> weights,
                        const std::vector<std::vector<double>>& light, std::size_t facets);

/// The facet's unit normal, out of the object.
glm::dvec3 normal_of(const Layout& layout, std::size_t facet, const glm::dvec2& slope);

/// The mean of Cost_N over all facets: 1 minus the mean of n . n' over a facet's neighbours, with unit normals n. The
/// thesis' (6.1), Cost_S = alpha_N Cost_N + alpha_P Cost_P, makes neighbours alike and the object easier to make.
double roughness(const Layout& layout, const std::vector<glm::dvec2>& slopes);

} // namespace nephroid::inverse
