#ifndef GPU_SHADING_PENUMBRA_LOGGING_H
#define GPU_SHADING_PENUMBRA_LOGGING_H

#include <courierr/courierr.h>

#include <iostream>
#include <string>
#include <string_view>

namespace Penumbra {

// Writes to standard output. A message context, if there is one, is a std::string.
class PenumbraLogger : public Courierr::Courierr {
 public:
  void error(const std::string_view message) override { write_message("ERROR", message); }
  void warning(const std::string_view message) override { write_message("WARNING", message); }
  void info(const std::string_view message) override { write_message("NOTE", message); }
  void debug(const std::string_view message) override { write_message("DEBUG", message); }

 protected:
  void write_message(const std::string_view message_type, const std::string_view message) {
    std::cout << "  [" << message_type << "]";
    if (message_context != nullptr) {
      std::cout << " (" << *static_cast<std::string const*>(message_context) << ")";
    }
    std::cout << " " << message << std::endl;
  }
};

// Its constructor passes the message to the logger as an error.
class PenumbraException : public Courierr::CourierrException {
 public:
  explicit PenumbraException(std::string const& text, Courierr::Courierr& logger)
      : CourierrException(text, logger) {}
};

// There is no surface of this index.
class SurfaceException : public PenumbraException {
 public:
  explicit SurfaceException(unsigned int const surface_index,
                            std::string_view const& surface_context, Courierr::Courierr& logger)
      : PenumbraException(std::string(surface_context) + " " + std::to_string(surface_index) +
                              " does not exist: surfaces are numbered from 0, as they were added",
                          logger) {}
};

}  // namespace Penumbra

#endif
