// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#include "mrpt_sgraphs/io/map_files.h"

#include <yaml-cpp/yaml.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <memory>
#include <stdexcept>

#include "mrpt_sgraphs/io/atomic_file.h"
#include "mrpt_sgraphs/mapping/octree.h"

namespace mrpt_sgraphs {
namespace {

namespace fs = std::filesystem;

// as map_saver writes them
constexpr unsigned char kBlack = 0;
constexpr unsigned char kGrey = 205;
constexpr unsigned char kWhite = 254;
constexpr const char* kOccupiedFrom = "0.65";
constexpr const char* kFreeTo = "0.196";

unsigned char greyOf(std::int8_t value) {
  if (value == FloorGrid::kOccupied) return kBlack;
  return value == FloorGrid::kFree ? kWhite : kGrey;
}

template <typename Write>
void writeFile(const fs::path& path, const Write& write) {
  AtomicFile file(path.string());
  write(file.stream());
  file.commit();
}

/// A binary PGM of one byte a pixel, row by row from above.
struct Image {
  int columns = 0;
  int rows = 0;
  int white = 255;
  std::vector<unsigned char> pixels;
};

/// The next number of a PGM's head; comments are passed over.
int numberIn(std::istream& in) {
  while (in >> std::ws && in.peek() == '#') in.ignore(1 << 20, '\n');
  int number = 0;
  in >> number;
  return number;
}

Image readPgm(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) throw std::runtime_error("cannot read '" + path.string() + "'");
  std::string magic;
  in >> magic;
  Image image;
  image.columns = numberIn(in);
  image.rows = numberIn(in);
  image.white = numberIn(in);
  constexpr int kMost = 1 << 15;
  if (!in || magic != "P5" || image.columns < 1 || image.columns > kMost || image.rows < 1 ||
      image.rows > kMost || image.white < 1 || image.white > 255) {
    throw std::runtime_error("'" + path.string() + "' is no binary PGM of one byte a pixel");
  }
  in.ignore(1);
  image.pixels.resize(static_cast<std::size_t>(image.columns) *
                      static_cast<std::size_t>(image.rows));
  in.read(reinterpret_cast<char*>(image.pixels.data()),
          static_cast<std::streamsize>(image.pixels.size()));
  if (!in) throw std::runtime_error("'" + path.string() + "' is cut short");
  return image;
}

constexpr const char* kTreeTitle = "# Octomap OcTree binary file";

/// As OctoMap's writeBinaryConst, which tells stderr of it.
void writeTree(const octomap::OcTree& tree, std::ostream& out) {
  out << kTreeTitle << "\n#\nid " << tree.getTreeType() << "\nsize " << tree.size() << "\nres "
      << tree.getResolution() << "\ndata\n";
  if (tree.getRoot() != nullptr && !tree.writeBinaryData(out)) {
    throw std::runtime_error("the OctoMap could not be written");
  }
}

/// As OctoMap's readBinary, which tells stderr of it.
std::unique_ptr<octomap::OcTree> readTree(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::string word;
  std::getline(in, word);
  if (!in || word != kTreeTitle) {
    throw std::runtime_error("'" + path + "' is no binary OctoMap");
  }
  std::size_t size = 0;
  double cell_m = 0.0;
  while (in >> word && word != "data") {
    if (word == "size") in >> size;
    if (word == "res") in >> cell_m;
    in.ignore(1 << 20, '\n');
  }
  in.ignore(1);
  if (!in || !(cell_m > 0.0)) throw std::runtime_error("the head of '" + path + "' is none");
  auto tree = std::make_unique<octomap::OcTree>(cell_m);
  if (size > 0) tree->readBinaryData(in);
  if (tree->size() != size) {
    throw std::runtime_error("'" + path + "' has " + std::to_string(tree->size()) +
                             " nodes and should have " + std::to_string(size));
  }
  return tree;
}

FloorGrid gridFrom(const YAML::Node& yaml, const fs::path& folder) {
  FloorGrid grid;
  grid.cell_m = yaml["resolution"].as<double>();
  const auto origin = yaml["origin"].as<std::vector<double>>();
  const bool is_negative = yaml["negate"].as<int>() != 0;
  const double occupied_from = yaml["occupied_thresh"].as<double>();
  const double free_to = yaml["free_thresh"].as<double>();
  if (origin.size() != 3 || origin[2] != 0.0 || !(grid.cell_m > 0.0)) {
    throw std::runtime_error("resolution or origin are none, or it is turned");
  }
  const Image image = readPgm(folder / yaml["image"].as<std::string>());
  const Cell min{static_cast<int>(std::lround(origin[0] / grid.cell_m)),
                 static_cast<int>(std::lround(origin[1] / grid.cell_m))};
  grid.cells = CellGrid<std::int8_t>(
      CellBox{min, {min.column + image.columns - 1, min.row + image.rows - 1}});
  grid.cells.forEach([&](Cell cell) {
    const int column = cell.column - min.column;
    const int row = image.rows - 1 - (cell.row - min.row);
    const double grey =
        image.pixels[static_cast<std::size_t>(row) * static_cast<std::size_t>(image.columns) +
                     static_cast<std::size_t>(column)] /
        255.0;
    const double occupied = is_negative ? grey : 1.0 - grey;
    grid.cells[cell] = occupied > occupied_from ? FloorGrid::kOccupied
                       : occupied < free_to     ? FloorGrid::kFree
                                                : FloorGrid::kUnknown;
  });
  return grid;
}

}  // namespace

void writePgm(const FloorGrid& grid, std::ostream& out) {
  const CellBox& box = grid.cells.box();
  out << "P5\n# " << grid.cell_m << " m a pixel\n"
      << box.columns() << ' ' << box.rows() << "\n255\n";
  std::string line;
  for (Cell cell{0, box.max.row}; cell.row >= box.min.row; --cell.row) {
    line.clear();
    for (cell.column = box.min.column; cell.column <= box.max.column; ++cell.column) {
      line.push_back(static_cast<char>(greyOf(grid.cells[cell])));
    }
    out.write(line.data(), static_cast<std::streamsize>(line.size()));
  }
}

void writeGridYaml(const FloorGrid& grid, const std::string& image, std::ostream& out) {
  const CellBox& box = grid.cells.box();
  constexpr int kMicrometres = 6;
  out << std::fixed << std::setprecision(kMicrometres) << "image: " << image
      << "\nresolution: " << grid.cell_m << "\norigin: [" << grid.cell_m * box.min.column << ", "
      << grid.cell_m * box.min.row << ", 0.0]\nnegate: 0\noccupied_thresh: " << kOccupiedFrom
      << "\nfree_thresh: " << kFreeTo << '\n';
}

void writeMapFiles(const std::string& folder, const GraphSnapshot& graph, const MapConfig& config) {
  OccupancyMap map(config);
  map.update(graph);
  writeFile(fs::path(folder) / "map.bt", [&](std::ostream& out) {
    writeTree(*octreeOf(map), out);
  });
  for (const FloorGrid& grid : floorGrids(map, graph, config)) {
    const std::string name = "floor_" + std::to_string(grid.floor.value);
    const std::string image = name + ".pgm";
    writeFile(fs::path(folder) / image, [&](std::ostream& out) { writePgm(grid, out); });
    writeFile(fs::path(folder) / (name + ".yaml"),
              [&](std::ostream& out) { writeGridYaml(grid, image, out); });
  }
}

FloorGrid readGrid(const std::string& yaml_path) {
  try {
    return gridFrom(YAML::LoadFile(yaml_path), fs::path(yaml_path).parent_path());
  } catch (const std::exception& error) {
    throw std::runtime_error("'" + yaml_path + "': " + error.what());
  }
}

std::vector<Eigen::Vector3f> readOccupiedCells(const std::string& path) {
  const auto tree = readTree(path);
  tree->expand();
  std::vector<Eigen::Vector3f> centres;
  for (auto leaf = tree->begin_leafs(); leaf != tree->end_leafs(); ++leaf) {
    if (!tree->isNodeOccupied(*leaf)) continue;
    centres.emplace_back(static_cast<float>(leaf.getX()), static_cast<float>(leaf.getY()),
                         static_cast<float>(leaf.getZ()));
  }
  return centres;
}

}  // namespace mrpt_sgraphs
