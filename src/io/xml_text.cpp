// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause

#include "xml_text.h"

#include <nlohmann/json.hpp>

namespace mrpt_sgraphs {
namespace {

constexpr const char* kReplacement = "\xEF\xBF\xBD";  ///< U+FFFD

/// The library for JSON knows what is UTF-8: what is not comes back replaced.
std::string utf8Of(const std::string& text) {
  using Json = nlohmann::json;
  const std::string quoted = Json(text).dump(-1, ' ', false, Json::error_handler_t::replace);
  return Json::parse(quoted).get<std::string>();
}

}  // namespace

std::string xmlText(const std::string& text) {
  std::string result;
  for (const char c : utf8Of(text)) {
    const auto byte = static_cast<unsigned char>(c);
    switch (c) {
      case '&': result += "&amp;"; break;
      case '<': result += "&lt;"; break;
      case '>': result += "&gt;"; break;
      case '"': result += "&quot;"; break;
      case '\'': result += "&apos;"; break;
      case '\t':
      case '\n':
      case '\r': result += ' '; break;
      default: result += byte < 0x20 ? std::string(kReplacement) : std::string(1, c);
    }
  }
  // the only characters above these that XML does not have
  for (const char* none : {"\xEF\xBF\xBE", "\xEF\xBF\xBF"}) {
    for (std::size_t at = result.find(none); at != std::string::npos; at = result.find(none, at)) {
      result.replace(at, 3, kReplacement);
    }
  }
  return result;
}

}  // namespace mrpt_sgraphs
