// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/io/state_files.h"

#include "mrpt_sgraphs/io/cloud_file.h"

namespace mrpt_sgraphs {
namespace {

/// What of a cloud is not in its file.
struct CloudHeader {
  KeyframeId keyframe;
  std::uint64_t stamp_us = 0;
  std::uint32_t seq = 0;
  std::string frame_id;
  bool is_dense = true;

  template <typename Archive>
  void archive(Archive& a) {
    a("keyframe", keyframe);
    a("stamp_us", stamp_us);
    a("seq", seq);
    a("frame_id", frame_id);
    a("is_dense", is_dense);
  }
};

}  // namespace

std::string cloudFileOf(KeyframeId keyframe) {
  return "clouds/" + std::to_string(keyframe.value) + ".pcd";
}

StateWriter::StateWriter(GraphSnapshotConstPtr graph) : graph_(std::move(graph)) {
  std::vector<CloudHeader> headers;
  for (const KeyframeNode& keyframe : graph_->keyframes) {
    if (keyframe.cloud == nullptr) continue;
    const pcl::PCLHeader& header = keyframe.cloud->header;
    headers.push_back(
        {keyframe.id, header.stamp, header.seq, header.frame_id, keyframe.cloud->is_dense});
  }
  ArchiveWriter a;
  a("headers", headers);
  files_["state/clouds.bin"] = a.bytes();
}

StateReader::StateReader(const std::string& folder) : folder_(folder) {
  std::vector<CloudHeader> headers;
  read("clouds", [&headers](auto& a) { a("headers", headers); });
  for (const CloudHeader& header : headers) {
    const std::string name = cloudFileOf(header.keyframe);
    const Cloud::Ptr cloud = readCloud(folder_.read(name), (folder_.path() / name).string());
    cloud->header.stamp = header.stamp_us;
    cloud->header.seq = header.seq;
    cloud->header.frame_id = header.frame_id;
    cloud->is_dense = header.is_dense;
    clouds_.emplace_back(header.keyframe, cloud);
  }
}

}  // namespace mrpt_sgraphs
