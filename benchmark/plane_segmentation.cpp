// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
//
// Planes of single scans, ours beside PCL's RANSAC, on the same scans of a simulated building:
//
//     plane_segmentation --building FILE.yaml [--sensor NAME ...] [--every N] [--csv FILE]
//
// PCL's way is the usual one: a voxel filter of 0.1 m, then SACSegmentation (0.03 m, 500 iterations)
// and ExtractIndices until ten planes are found or a tenth of the points is left. The two take turns
// on each scan. CPU time of one thread. Walls count as there if 2 m^2 of their face were hit from
// within 10 m (cells of 0.25 m), and as found by a plane within 2 degrees and 5 cm that has its
// centroid on them; PCL does not say from which side a plane was seen, so either will do for it.
#include <pcl/filters/extract_indices.h>
#include <pcl/filters/voxel_grid.h>
#include <pcl/segmentation/sac_segmentation.h>

#include <algorithm>
#include <boost/program_options.hpp>
#include <cstdio>
#include <exception>
#include <fstream>
#include <iostream>
#include <set>
#include <string>
#include <vector>

#include "mrpt_sgraphs/frontend/plane_segmentation.h"
#include "mrpt_sgraphs/geometry/cpu_time.h"
#include "mrpt_sgraphs/geometry/scatter.h"
#include "mrpt_sgraphs/io/statistics.h"
#include "sim/simulation.h"
#include "sim/wall_faces.h"

namespace mrpt_sgraphs {
namespace {

namespace po = boost::program_options;

constexpr double kMedian = 0.5;
constexpr char kDense[] = "64x2048";

/// A plane that was found, in the map.
struct Found {
  Plane plane_map;
  Eigen::Vector3d centroid_map;
  bool has_side;
};

/// What one way of doing it came to, over all scans.
struct Tally {
  std::vector<double> ms;
  std::vector<double> normal_deg;
  std::vector<double> offset_m;
  int planes = 0;
  int walls = 0;
  int found = 0;
};

/// The sweep as if it had been taken at its start; base frame.
Cloud straightened(const sim::LidarScan& scan, const sim::Simulation& simulation) {
  constexpr double kSecondsPerNs = 1e-9;
  const auto T_map_base = [&](int64_t time_ns) {
    return simulation.trajectory().T_map_base(static_cast<double>(time_ns) * kSecondsPerNs);
  };
  const Pose T_base_map = T_map_base(scan.start_ns).inverse();
  Cloud cloud;
  cloud.sensor_origin_.head<3>() = simulation.T_base_lidar().translation().cast<float>();
  for (const sim::LidarReturn& echo : scan.returns) {
    const Pose T_map_lidar =
        T_map_base(scan.start_ns + echo.offset_ns) * simulation.T_base_lidar();
    Point point;
    point.getVector3fMap() =
        (T_base_map * T_map_lidar * echo.point_lidar.cast<double>()).cast<float>();
    point.data[3] = 1.0F;
    point.ring = echo.ring;
    cloud.push_back(point);
  }
  return cloud;
}

std::vector<Found> segmentByRansac(const Cloud& cloud, const Pose& T_map_base, double* ms) {
  constexpr float kVoxel_m = 0.1F;
  constexpr double kDistance_m = 0.03;
  constexpr int kIterations = 500;
  constexpr int kPlanes = 10;
  constexpr double kRest = 0.1;
  using Cloud3 = pcl::PointCloud<pcl::PointXYZ>;
  Cloud3::Ptr input(new Cloud3);
  for (const Point& p : cloud) input->push_back({p.x, p.y, p.z});

  CpuStopwatch watch;
  std::vector<std::pair<Eigen::Vector4f, Cloud3::Ptr>> planes;
  pcl::VoxelGrid<pcl::PointXYZ> voxels;
  voxels.setLeafSize(kVoxel_m, kVoxel_m, kVoxel_m);
  voxels.setInputCloud(input);
  Cloud3::Ptr rest(new Cloud3);
  voxels.filter(*rest);
  const double enough = kRest * static_cast<double>(rest->size());
  while (static_cast<double>(rest->size()) > enough && planes.size() < kPlanes) {
    pcl::SACSegmentation<pcl::PointXYZ> ransac;
    ransac.setModelType(pcl::SACMODEL_PLANE);
    ransac.setMethodType(pcl::SAC_RANSAC);
    ransac.setDistanceThreshold(kDistance_m);
    ransac.setMaxIterations(kIterations);
    ransac.setInputCloud(rest);
    pcl::ModelCoefficients coefficients;
    pcl::PointIndices::Ptr inliers(new pcl::PointIndices);
    ransac.segment(*inliers, coefficients);
    if (inliers->indices.empty()) break;
    pcl::ExtractIndices<pcl::PointXYZ> extract;
    extract.setInputCloud(rest);
    extract.setIndices(inliers);
    Cloud3::Ptr plane(new Cloud3);
    extract.filter(*plane);
    Cloud3::Ptr others(new Cloud3);
    extract.setNegative(true);
    extract.filter(*others);
    rest = others;
    planes.emplace_back(Eigen::Vector4f(coefficients.values.data()), plane);
  }
  *ms = watch.lap();

  std::vector<Found> found;
  for (const auto& [coefficients, points] : planes) {
    const Eigen::Vector3d normal = coefficients.head<3>().cast<double>();
    const double length = normal.norm();
    const Plane plane_base{normal / length, -coefficients[3] / length};
    Scatter scatter;
    for (const pcl::PointXYZ& p : *points) scatter.add(p.getVector3fMap().cast<double>());
    found.push_back({T_map_base * plane_base, T_map_base * scatter.mean(), false});
  }
  return found;
}

std::vector<Found> segmentByUs(const Cloud& cloud, const Pose& T_map_base, double* ms) {
  const GatheredPoints points = gatheredFrom(cloud);
  CpuStopwatch watch;
  const std::vector<PlaneSegment> segments = segmentPlanes(points, {});
  *ms = watch.lap();
  std::vector<Found> found;
  for (const PlaneSegment& segment : segments) {
    found.push_back({T_map_base * segment.plane_base, T_map_base * segment.centroid_base, true});
  }
  return found;
}

/// Along a face and up, if the point lies on it.
std::optional<Eigen::Vector2d> onFace(const sim::WallFace& face, const Eigen::Vector3d& point_map,
                                      double tolerance_m) {
  const Eigen::Vector2d from_first = point_map.head<2>() - face.first;
  const double s = face.along().dot(from_first);
  const double up = point_map.z() - face.floor_m;
  const bool within = s >= 0.0 && s <= face.length_m() && up >= 0.0 && up <= face.height_m;
  if (!within || std::abs(face.inward().dot(from_first)) > tolerance_m) return std::nullopt;
  return Eigen::Vector2d(s, up);
}

/// The faces that are to be found in a scan.
std::vector<sim::WallFace> facesIn(const Cloud& cloud, const Pose& T_map_base,
                                   const std::vector<sim::WallFace>& faces) {
  constexpr double kCell_m = 0.25;
  constexpr double kMaxRange_m = 10.0;
  constexpr double kMinArea_m2 = 2.0;
  constexpr double kNoise_m = 0.06;
  const Eigen::Vector3d viewpoint_map = T_map_base * viewpointOf(cloud);
  std::vector<sim::WallFace> seen;
  for (const sim::WallFace& face : faces) {
    if (face.inward().dot(viewpoint_map.head<2>() - face.first) < 0.0) continue;
    std::set<std::pair<int, int>> cells;
    for (const Point& p : cloud) {
      const Eigen::Vector3d p_map = T_map_base * Eigen::Vector3d(p.getVector3fMap().cast<double>());
      if ((p_map - viewpoint_map).norm() > kMaxRange_m) continue;
      const auto at = onFace(face, p_map, kNoise_m);
      if (at) cells.insert({int(at->x() / kCell_m), int(at->y() / kCell_m)});
    }
    if (static_cast<double>(cells.size()) * kCell_m * kCell_m >= kMinArea_m2) seen.push_back(face);
  }
  return seen;
}

void count(const std::vector<Found>& planes, const std::vector<sim::WallFace>& faces,
           double time_ms, Tally* tally) {
  constexpr double kMaxOffset_m = 0.05;
  const double kMinCosine = std::cos(2.0 * M_PI / 180.0);
  tally->ms.push_back(time_ms);
  tally->planes += static_cast<int>(planes.size());
  tally->walls += static_cast<int>(faces.size());
  for (const sim::WallFace& face : faces) {
    const Eigen::Vector3d normal(face.inward().x(), face.inward().y(), 0.0);
    for (const Found& plane : planes) {
      const double cosine = plane.plane_map.normal.dot(normal);
      if ((plane.has_side ? cosine : std::abs(cosine)) < kMinCosine) continue;
      if (!onFace(face, plane.centroid_map, kMaxOffset_m)) continue;
      ++tally->found;
      tally->normal_deg.push_back(
          std::acos(std::min(1.0, std::abs(cosine))) * 180.0 / M_PI);
      tally->offset_m.push_back(std::abs(
          face.inward().dot(plane.centroid_map.head<2>() - face.first)));
      break;
    }
  }
}

void print(const char* name, const Tally& tally) {
  const double scans = static_cast<double>(tally.ms.size());
  std::printf("  %-10s %9.2f %9.2f %8.1f %12d %8.3f %14.3f %14.4f\n", name,
              quantile(tally.ms, kMedian), quantile(tally.ms, 0.95), tally.planes / scans,
              tally.walls, static_cast<double>(tally.found) / std::max(1, tally.walls),
              tally.normal_deg.empty() ? 0.0 : quantile(tally.normal_deg, kMedian),
              tally.offset_m.empty() ? 0.0 : quantile(tally.offset_m, kMedian));
}

void compare(const sim::Building& building, const sim::LidarModel& lidar, int every,
             std::ofstream* csv) {
  sim::SimulationConfig config;
  config.lidar = lidar;
  config.robot = sim::robotNamed("legged");
  config.max_duration_s = 600.0;
  sim::Simulation simulation(building, config);
  const std::vector<sim::WallFace> faces = sim::wallFaces(building);
  const sim::Scene scene(building);
  sim::Lidar sensor(lidar, simulation.T_base_lidar(), scene, simulation.trajectory(), 1);
  Tally ours, ransac;
  std::vector<double> points;
  for (int64_t k = 0; k < simulation.scanCount(); k += every) {
    const sim::LidarScan scan = sensor.scan(k);
    const Cloud cloud = straightened(scan, simulation);
    const Pose T_map_base = simulation.trajectory().T_map_base(1e-9 * scan.start_ns);
    const auto there = facesIn(cloud, T_map_base, faces);
    double ours_ms = 0.0, ransac_ms = 0.0;
    const auto our_planes = segmentByUs(cloud, T_map_base, &ours_ms);
    const auto ransac_planes = segmentByRansac(cloud, T_map_base, &ransac_ms);
    count(our_planes, there, ours_ms, &ours);
    count(ransac_planes, there, ransac_ms, &ransac);
    points.push_back(static_cast<double>(cloud.size()));
    if (csv->is_open()) {
      *csv << lidar.name << ',' << k << ',' << cloud.size() << ',' << ours_ms << ',' << ransac_ms
           << '\n';
    }
  }
  std::printf("%s, %d x %d: %zu scans of %.0f points (median)\n", lidar.name.c_str(), lidar.rings,
              lidar.columns, points.size(), quantile(points, kMedian));
  std::printf("  %-10s %9s %9s %8s %12s %8s %14s %14s\n", "", "median ms", "p95 ms", "planes",
              "walls there", "recall", "normal deg", "offset m");
  print("ours", ours);
  print("PCL RANSAC", ransac);
  std::printf("  time ours / RANSAC (medians): 1/%.1f\n\n",
              quantile(ransac.ms, kMedian) / quantile(ours.ms, kMedian));
}

/// The simulator's, and one of 64 x 2048 points.
sim::LidarModel lidarNamed(const std::string& name) {
  if (name != kDense) return sim::lidarNamed(name);
  sim::LidarModel dense = sim::lidarNamed("os1_64");
  dense.name = kDense;
  dense.columns = 2048;
  return dense;
}

int run(int argc, char** argv) {
  std::string building_file, csv_file;
  std::vector<std::string> sensors;
  int every = 40;
  po::options_description options("Options");
  auto add = options.add_options();
  add("building", po::value(&building_file)->required());
  add("sensor", po::value(&sensors)->multitoken()->default_value({"vlp16", kDense}, "vlp16 64x2048"));
  add("every", po::value(&every), "of the walk's scans are used");
  add("csv", po::value(&csv_file), "a row for every scan");
  po::variables_map values;
  po::store(po::parse_command_line(argc, argv, options), values);
  po::notify(values);

  const sim::Building building = sim::loadBuilding(building_file);
  std::ofstream csv(csv_file);
  if (csv.is_open()) csv << "sensor,scan,points,ours_ms,ransac_ms\n";
  for (const std::string& name : sensors) {
    compare(building, lidarNamed(name), std::max(1, every), &csv);
  }
  return 0;
}

}  // namespace
}  // namespace mrpt_sgraphs

int main(int argc, char** argv) {
  try {
    return mrpt_sgraphs::run(argc, argv);
  } catch (const std::exception& error) {
    std::cerr << "plane_segmentation: " << error.what() << '\n';
    return 1;
  }
}
