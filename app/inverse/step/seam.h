// SPDX-License-Identifier: Apache-2.0
// The seam between step.cpp and the module that knows OpenCascade (occt/module.cpp), which is in a package of its own
// and loaded late. Not for others: include inverse/step/step.h.
#pragma once
#include <glm/glm.hpp>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace nephroid::inverse {

/// A planar face.
struct StepFace {
  glm::dvec3 at{0}, normal{0};     ///< its plane; the normal, of unit length, is out of the solid
  std::vector<std::uint32_t> ring; ///< vertices around it, counter-clockwise seen from outside
};

/// A relief z(x, y) as a bicubic B-spline with equal steps, over a rectangle about the z axis. Millimetres.
struct StepSpline {
  glm::dvec2 size{0};          ///< of the rectangle
  int columns = 0, rows = 0;   ///< steps along x, and along y from the top
  std::vector<double> heights; ///< of the bells: 3 more each way than steps, row by row from the top
  bool round = false;          ///< cut along the ellipse within the rectangle
  double front = 0;            ///< z of the flat front
};

/// Either planar faces, which share vertices and close a solid, or a spline's solid.
struct StepSolid {
  std::string name;
  std::vector<glm::dvec3> vertices;
  std::vector<StepFace> faces;
  StepSpline spline; ///< where there are no faces
};

/// What was read back from the file.
struct StepRead {
  std::size_t faces = 0;
  double volume = 0;
};

/// What OpenCascade does not do, and why.
struct StepRefused {
  std::string reason;
};

/// Both throw StepRefused.
struct StepModule {
  void (*write)(const StepSolid& solid, const std::string& file);
  StepRead (*read)(const std::string& file);
};

inline constexpr const char *step_module_name = "libnephroid_step.so", *step_module_symbol = "nephroid_step_module";

} // namespace nephroid::inverse
