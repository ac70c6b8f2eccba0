// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "mrpt_sgraphs/io/folder_version.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <optional>
#include <stdexcept>
#include <system_error>
#include <vector>

#include "mrpt_sgraphs/io/map_folder.h"

namespace mrpt_sgraphs {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& path, const std::string& reason) {
  throw std::runtime_error("cannot write the folder '" + path.string() + "': " + reason);
}

/// What `work` does to files.
template <typename Work>
auto reported(const fs::path& path, const Work& work) {
  try {
    return work();
  } catch (const fs::filesystem_error& error) {
    fail(path, error.code().message());
  }
}

/// Without what a trailing slash leaves, and not through the link.
fs::path withoutSlash(const std::string& path) {
  fs::path absolute = fs::absolute(path).lexically_normal();
  return absolute.has_filename() ? absolute : absolute.parent_path();
}

/// 4 for `map.v4` beside `map`.
std::optional<unsigned long> versionOf(const fs::path& entry, const fs::path& link) {
  const std::string prefix = link.filename().string() + ".v";
  const std::string name = entry.filename().string();
  if (name.size() <= prefix.size() || name.compare(0, prefix.size(), prefix) != 0) {
    return std::nullopt;
  }
  const std::string digits = name.substr(prefix.size());
  if (digits.size() > 9 || digits.find_first_not_of("0123456789") != std::string::npos) {
    return std::nullopt;
  }
  return std::stoul(digits);
}

/// What cannot be replaced by a link.
bool isMounted(const fs::path& folder) {
  struct stat own {};
  struct stat parent {};
  return lstat(folder.c_str(), &own) == 0 && S_ISDIR(own.st_mode) &&
         stat(folder.parent_path().c_str(), &parent) == 0 && own.st_dev != parent.st_dev;
}

std::vector<fs::path> versionsOf(const fs::path& link) {
  std::vector<fs::path> versions;
  for (const auto& entry : fs::directory_iterator(link.parent_path())) {
    if (versionOf(entry.path(), link) && entry.is_directory() && !entry.is_symlink()) {
      versions.push_back(entry.path());
    }
  }
  return versions;
}

void sync(const fs::path& folder) {
  const int descriptor = open(folder.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) fail(folder, std::strerror(errno));
  syncfs(descriptor);  // a file system that cannot is as safe as it gets
  close(descriptor);
}

/// Files that are not the map's own: linked, so that they are in both and nothing is copied.
void carryOver(const fs::path& from, const fs::path& to) {
  for (const auto& entry : fs::recursive_directory_iterator(from)) {
    const fs::path relative = fs::relative(entry.path(), from);
    if (entry.is_directory() && !entry.is_symlink()) continue;
    if (isOfMap(relative) || fs::exists(fs::symlink_status(to / relative))) continue;
    fs::create_directories((to / relative).parent_path());
    std::error_code no_links;
    fs::create_hard_link(entry.path(), to / relative, no_links);
    if (no_links) fs::copy(entry.path(), to / relative, fs::copy_options::copy_symlinks);
  }
}

/// The link takes the place of whatever is at `path`, in one step where the file system can.
void switchTo(const fs::path& target, const fs::path& path) {
  const fs::path next = path.string() + ".v.next";
  fs::remove(next);
  fs::create_directory_symlink(target.filename(), next);
  const bool is_folder = fs::is_directory(fs::symlink_status(path));
  if (!is_folder) {
    fs::rename(next, path);
    return;
  }
  // the old folder is under the name of the link then
  if (renameat2(AT_FDCWD, next.c_str(), AT_FDCWD, path.c_str(), RENAME_EXCHANGE) != 0) {
    const fs::path aside = path.string() + ".v0";
    fs::rename(path, aside);
    fs::rename(next, path);
    fs::remove_all(aside);
    return;
  }
  fs::remove_all(next);
}

}  // namespace

FolderVersion::FolderVersion(const std::string& path) : link_(withoutSlash(path)) {
  if (path.empty()) fail(path, "it has no name");
  reported(link_, [&] {
    fs::create_directories(link_.parent_path());
    if (fs::exists(link_) && !fs::is_directory(link_)) fail(link_, "it is a file");
    if (isMounted(link_)) fail(link_, "it is a disk of its own; name a folder on it");
    unsigned long version = 0;
    for (const fs::path& known : versionsOf(link_)) {
      version = std::max(version, *versionOf(known, link_));
    }
    folder_ = link_.string() + ".v" + std::to_string(version + 1);
    if (!fs::create_directory(folder_)) fail(folder_, "somebody else is writing it");
    return 0;
  });
}

FolderVersion::~FolderVersion() {
  std::error_code whatever;
  if (!is_committed_) fs::remove_all(folder_, whatever);
}

void FolderVersion::commit() {
  reported(link_, [&] {
    if (fs::exists(link_)) carryOver(fs::canonical(link_), folder_);
    writeManifest(folder_);
    sync(folder_);
    switchTo(folder_, link_);
    is_committed_ = true;
    sync(link_.parent_path());
    for (const fs::path& known : versionsOf(link_)) {
      if (*versionOf(known, link_) < *versionOf(folder_, link_)) fs::remove_all(known);
    }
    return 0;
  });
}

}  // namespace mrpt_sgraphs
