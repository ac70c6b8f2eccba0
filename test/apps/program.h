// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include "../io/temporary_folder.h"

namespace mrpt_sgraphs::test {

/// How a program ended and what it said.
struct ProgramResult {
  int exit_code = 0;  ///< Minus the signal that ended it, if one did.
  std::string out;
  std::string err;

  bool says(const std::string& text) const { return err.find(text) != std::string::npos; }
};

constexpr int kNoSuchProgram = 127;  ///< As shells have it.

using Arguments = std::vector<std::string>;

/// Runs a program to its end; one that hangs is ended by SIGALRM.
/// @param prepare  What the new process does before it becomes the program.
inline ProgramResult runProgram(const std::string& program, const Arguments& arguments,
                                const std::function<void()>& prepare = {}) {
  constexpr unsigned kMost_s = 300;
  const TemporaryFolder said;
  const std::string out = said.file("out");
  const std::string err = said.file("err");
  std::vector<char*> argv{const_cast<char*>(program.c_str())};
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);

  const pid_t process = fork();
  if (process < 0) throw std::runtime_error("cannot fork");
  if (process == 0) {
    constexpr int kMode = 0600;
    dup2(open(out.c_str(), O_CREAT | O_WRONLY, kMode), STDOUT_FILENO);
    dup2(open(err.c_str(), O_CREAT | O_WRONLY, kMode), STDERR_FILENO);
    alarm(kMost_s);
    if (prepare) prepare();
    execvp(program.c_str(), argv.data());
    _exit(kNoSuchProgram);
  }
  int status = 0;
  waitpid(process, &status, 0);
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status), said.read("out"),
          said.read("err")};
}

constexpr int kFailed = 1;
constexpr int kWrongUsage = 2;

inline ProgramResult runOffline(const Arguments& arguments,
                                const std::function<void()>& prepare = {}) {
  return runProgram(OFFLINE_PROGRAM, arguments, prepare);
}

/// With the options that there always are.
inline ProgramResult runOffline(const std::string& bag, const std::string& out,
                                const Arguments& further = {}) {
  Arguments arguments{"--bag", bag, "--points", "/points", "--out", out};
  arguments.insert(arguments.end(), further.begin(), further.end());
  return runOffline(arguments);
}

}  // namespace mrpt_sgraphs::test
