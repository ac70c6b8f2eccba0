// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <ostream>
#include <string>

#include "mrpt_sgraphs/geometry/plane_frame.h"

namespace mrpt_sgraphs {

/// Writes a drawing in metres of the map, x to the right and y up, as an SVG file.
class SvgCanvas {
 public:
  enum class Anchor { kBegin, kMiddle };
  enum class Dashes { kNo, kYes };

  /// @param page_map  What is shown.
  SvgCanvas(const Eigen::AlignedBox2d& page_map, const std::string& title, std::ostream& out);
  ~SvgCanvas();  ///< Ends the file.

  SvgCanvas(const SvgCanvas&) = delete;
  SvgCanvas& operator=(const SvgCanvas&) = delete;

  void beginGroup(const std::string& id);
  void endGroup();
  /// @param hint  Browsers show it under the pointer.
  void area(const PlanarExtent& extent_map, const std::string& fill, const std::string& hint);
  void polygon(const Outline2& corners_map, const std::string& fill);
  void line(const Eigen::Vector2d& begin_map, const Eigen::Vector2d& end_map, double width_m,
            const std::string& colour, Dashes dashes = Dashes::kNo);
  void disc(const Eigen::Vector2d& centre_map, double radius_m, const std::string& fill);
  /// @param place_map  On the line that the letters stand on.
  /// @param turn_rad   Counter-clockwise.
  void text(const Eigen::Vector2d& place_map, const std::string& text, double size_m,
            double turn_rad, const std::string& colour, Anchor anchor = Anchor::kMiddle);

 private:
  std::string number(double value) const;
  std::string length(double value_m) const;
  std::string point(const Eigen::Vector2d& p_map) const;
  std::string attribute(const char* name, const std::string& value) const;
  void addRing(const Outline3& ring_map, std::string* path) const;

  const Eigen::AlignedBox2d page_map_;
  std::ostream& out_;
};

}  // namespace mrpt_sgraphs
