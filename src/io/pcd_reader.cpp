// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "mrpt_sgraphs/io/pcd_reader.h"

#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <locale>
#include <sstream>
#include <stdexcept>

namespace mrpt_sgraphs {
namespace {

/// Where x, y and z are: bytes within a binary point, words within a line.
struct Layout {
  std::size_t points = 0;
  std::size_t point_bytes = 0;
  std::array<std::size_t, 3> byte{};
  std::array<std::size_t, 3> word{};
  bool binary = false;
};

template <typename T>
std::vector<T> rest(std::istringstream& words) {
  std::vector<T> values;
  for (T value; words >> value;) values.push_back(value);
  return values;
}

/// Finds x, y and z among the fields.
void place(const std::vector<std::string>& fields, const std::vector<std::size_t>& sizes,
           const std::vector<char>& types, std::vector<std::size_t> counts, Layout* layout) {
  if (counts.empty()) counts.assign(fields.size(), 1);
  if (sizes.size() != fields.size() || types.size() != fields.size() ||
      counts.size() != fields.size()) {
    throw std::runtime_error("its FIELDS, SIZE, TYPE and COUNT differ in length");
  }
  std::size_t byte = 0;
  std::size_t word = 0;
  int found = 0;
  for (std::size_t k = 0; k < fields.size(); ++k) {
    const std::size_t axis = std::string("xyz").find(fields[k]);
    if (fields[k].size() == 1 && axis != std::string::npos) {
      if (sizes[k] != sizeof(float) || types[k] != 'F') {
        throw std::runtime_error("its field '" + fields[k] + "' is not a 4-byte float");
      }
      layout->byte[axis] = byte;
      layout->word[axis] = word;
      ++found;
    }
    byte += sizes[k] * counts[k];
    word += counts[k];
  }
  if (found != 3) throw std::runtime_error("it has no fields x, y and z");
  layout->point_bytes = byte;
}

Layout readHeader(std::istream& file) {
  Layout layout;
  std::vector<std::string> fields;
  std::vector<std::size_t> sizes;
  std::vector<char> types;
  std::vector<std::size_t> counts;
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    std::string key;
    words >> key;
    if (key == "FIELDS") fields = rest<std::string>(words);
    if (key == "SIZE") sizes = rest<std::size_t>(words);
    if (key == "TYPE") types = rest<char>(words);
    if (key == "COUNT") counts = rest<std::size_t>(words);
    if (key == "POINTS") words >> layout.points;
    if (key != "DATA") continue;

    std::string encoding;
    words >> encoding;
    if (encoding != "binary" && encoding != "ascii") {
      throw std::runtime_error("its DATA is '" + encoding + "', not binary or ascii");
    }
    layout.binary = encoding == "binary";
    place(fields, sizes, types, counts, &layout);
    return layout;
  }
  throw std::runtime_error("its header has no DATA line");
}

Eigen::Vector3f readBinaryPoint(std::istream& file, const Layout& layout, std::string* buffer) {
  buffer->resize(layout.point_bytes);
  file.read(buffer->data(), static_cast<std::streamsize>(layout.point_bytes));
  Eigen::Vector3f point = Eigen::Vector3f::Zero();
  if (!file) return point;
  for (int axis = 0; axis < 3; ++axis) {
    const std::size_t offset = layout.byte[static_cast<std::size_t>(axis)];
    std::memcpy(&point[axis], buffer->data() + offset, sizeof(float));
  }
  return point;
}

Eigen::Vector3f readAsciiPoint(std::istream& file, const Layout& layout, std::string* buffer) {
  std::getline(file, *buffer);
  std::istringstream words(*buffer);
  const std::vector<std::string> values = rest<std::string>(words);
  Eigen::Vector3f point = Eigen::Vector3f::Zero();
  for (int axis = 0; axis < 3; ++axis) {
    const std::size_t word = layout.word[static_cast<std::size_t>(axis)];
    if (word >= values.size()) {
      file.setstate(std::ios::failbit);
      return point;
    }
    point[axis] = std::strtof(values[word].c_str(), nullptr);  // understands nan, which >> does not
  }
  return point;
}

std::vector<Eigen::Vector3f> readPoints(std::istream& file) {
  const Layout layout = readHeader(file);
  std::vector<Eigen::Vector3f> points;
  std::string buffer;
  for (std::size_t k = 0; k < layout.points; ++k) {
    const Eigen::Vector3f point = layout.binary ? readBinaryPoint(file, layout, &buffer)
                                                : readAsciiPoint(file, layout, &buffer);
    if (!file) {
      throw std::runtime_error("it ends at point " + std::to_string(k + 1) + " of " +
                               std::to_string(layout.points));
    }
    if (point.allFinite()) points.push_back(point);
  }
  return points;
}

}  // namespace

std::vector<Eigen::Vector3f> readPcd(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error("cannot read '" + path + "': " + std::strerror(errno));
  try {
    return readPoints(file);
  } catch (const std::runtime_error& error) {
    throw std::runtime_error("cannot read '" + path + "': " + error.what());
  }
}

}  // namespace mrpt_sgraphs
