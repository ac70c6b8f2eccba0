// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

/// Prints docs/parameters.md:
///
///     sgraphs_parameters config/default.yaml > docs/parameters.md

#include <exception>
#include <fstream>
#include <iostream>

#include "mrpt_sgraphs/slam/parameter_docs.h"

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "sgraphs_parameters config/default.yaml > docs/parameters.md\n";
    return 2;
  }
  try {
    std::ifstream yaml(argv[1]);
    if (!yaml) throw std::runtime_error(std::string("cannot read '") + argv[1] + "'");
    mrpt_sgraphs::writeParameterDocs(yaml, std::cout);
  } catch (const std::exception& error) {
    std::cerr << "sgraphs_parameters: " << error.what() << '\n';
    return 1;
  }
  return std::cout.flush() ? 0 : 1;
}
