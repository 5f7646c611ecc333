#include "platform/markup_text.h"

#include <nlohmann/json.hpp>

namespace gpu_shading::energyplus {

std::string valid_utf8(std::string const& text) {
  using Json = nlohmann::json;
  return Json::parse(Json(text).dump(-1, ' ', false, Json::error_handler_t::replace))
      .get<std::string>();
}

std::string markup_text(std::string const& text) {
  constexpr unsigned char first_printable = 0x20;
  std::string escaped;
  for (char const character : valid_utf8(text)) {
    switch (character) {
      case '&':
        escaped += "&amp;";
        break;
      case '<':
        escaped += "&lt;";
        break;
      case '>':
        escaped += "&gt;";
        break;
      case '"':
        escaped += "&quot;";
        break;
      default:
        escaped += static_cast<unsigned char>(character) < first_printable ? '?' : character;
    }
  }
  return escaped;
}

}  // namespace gpu_shading::energyplus
