// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "svg_canvas.h"

#include <cmath>
#include <iomanip>
#include <locale>
#include <sstream>

#include "xml_text.h"

namespace mrpt_sgraphs {
namespace {

constexpr double kPixels_per_m = 40.0;  ///< Browsers do not draw letters smaller than a pixel.

}  // namespace

SvgCanvas::SvgCanvas(const Eigen::AlignedBox2d& page_map, const std::string& title,
                     std::ostream& out)
    : page_map_(page_map), out_(out) {
  const Eigen::Vector2d size_m = page_map.sizes();
  const std::string width = length(size_m.x());
  const std::string height = length(size_m.y());
  out_ << "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
       << "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" << width << "\" height=\"" << height
       << "\" viewBox=\"0 0 " << width << ' ' << height << "\" font-family=\"sans-serif\">\n"
       << "<title>" << xmlText(title) << "</title>\n"
       << "<rect width=\"" << width << "\" height=\"" << height << "\" fill=\"#ffffff\"/>\n";
}

SvgCanvas::~SvgCanvas() { out_ << "</svg>\n"; }

void SvgCanvas::beginGroup(const std::string& id) {
  out_ << "<g" << attribute("id", id) << ">\n";
}

void SvgCanvas::endGroup() { out_ << "</g>\n"; }

void SvgCanvas::area(const PlanarExtent& extent_map, const std::string& fill,
                     const std::string& hint) {
  std::string path;
  addRing(extent_map.outline, &path);
  for (const Outline3& hole : extent_map.holes) addRing(hole, &path);
  out_ << "<path" << attribute("fill", fill) << attribute("fill-rule", "evenodd")
       << attribute("d", path) << "><title>" << xmlText(hint) << "</title></path>\n";
}

void SvgCanvas::polygon(const Outline2& corners_map, const std::string& fill) {
  std::string points;
  for (const Eigen::Vector2d& corner : corners_map) points += point(corner) + ' ';
  out_ << "<polygon" << attribute("fill", fill) << attribute("points", points) << "/>\n";
}

void SvgCanvas::line(const Eigen::Vector2d& begin_map, const Eigen::Vector2d& end_map,
                     double width_m, const std::string& colour, Dashes dashes) {
  const std::string path = "M " + point(begin_map) + " L " + point(end_map);
  out_ << "<path" << attribute("stroke", colour) << attribute("stroke-width", length(width_m))
       << attribute("d", path);
  if (dashes == Dashes::kYes) out_ << attribute("stroke-dasharray", length(3.0 * width_m));
  out_ << "/>\n";
}

void SvgCanvas::disc(const Eigen::Vector2d& centre_map, double radius_m, const std::string& fill) {
  const Eigen::Vector2d centre = centre_map - page_map_.min();
  out_ << "<circle" << attribute("cx", length(centre.x()))
       << attribute("cy", length(page_map_.sizes().y() - centre.y()))
       << attribute("r", length(radius_m)) << attribute("fill", fill) << "/>\n";
}

void SvgCanvas::text(const Eigen::Vector2d& place_map, const std::string& text, double size_m,
                     double turn_rad, const std::string& colour, Anchor anchor) {
  constexpr double kDegrees = 180.0 / M_PI;
  const std::string transform =
      "translate(" + point(place_map) + ") rotate(" + number(-turn_rad * kDegrees) + ")";
  out_ << "<text" << attribute("transform", transform) << attribute("font-size", length(size_m))
       << attribute("fill", colour);
  if (anchor == Anchor::kMiddle) out_ << attribute("text-anchor", "middle");
  out_ << '>' << xmlText(text) << "</text>\n";
}

std::string SvgCanvas::number(double value) const {
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text << std::fixed << std::setprecision(1) << value;
  return text.str() == "-0.0" ? "0.0" : text.str();
}

std::string SvgCanvas::length(double value_m) const { return number(kPixels_per_m * value_m); }

std::string SvgCanvas::point(const Eigen::Vector2d& p_map) const {
  const Eigen::Vector2d p = p_map - page_map_.min();
  return length(p.x()) + ' ' + length(page_map_.sizes().y() - p.y());
}

std::string SvgCanvas::attribute(const char* name, const std::string& value) const {
  return std::string(" ") + name + "=\"" + xmlText(value) + '"';
}

void SvgCanvas::addRing(const Outline3& ring_map, std::string* path) const {
  const char* command = "M ";
  for (const Eigen::Vector3d& corner : ring_map) {
    *path += command + point(corner.head<2>()) + ' ';
    command = "L ";
  }
  *path += "Z ";
}

}  // namespace mrpt_sgraphs
