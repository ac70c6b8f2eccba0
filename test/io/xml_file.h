// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <tinyxml2.h>

#include <stdexcept>
#include <string>
#include <vector>

namespace mrpt_sgraphs::test {

/// A text as a parser of XML has it.
class XmlFile {
 public:
  explicit XmlFile(const std::string& text) {
    if (document_.Parse(text.c_str(), text.size()) != tinyxml2::XML_SUCCESS) {
      throw std::runtime_error(document_.ErrorStr());
    }
  }

  const tinyxml2::XMLElement& root() const { return *document_.RootElement(); }

  /// All below the root, whatever they are in.
  std::vector<const tinyxml2::XMLElement*> elements(const std::string& name) const {
    std::vector<const tinyxml2::XMLElement*> found;
    collect(root(), name, &found);
    return found;
  }

 private:
  static void collect(const tinyxml2::XMLElement& parent, const std::string& name,
                      std::vector<const tinyxml2::XMLElement*>* found) {
    for (const auto* child = parent.FirstChildElement(); child != nullptr;
         child = child->NextSiblingElement()) {
      if (child->Name() == name) found->push_back(child);
      collect(*child, name, found);
    }
  }

  tinyxml2::XMLDocument document_;
};

}  // namespace mrpt_sgraphs::test
