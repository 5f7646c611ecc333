#ifndef GPU_SHADING_COURIERR_H
#define GPU_SHADING_COURIERR_H

#include <exception>
#include <string>
#include <string_view>

// The part of the logging interface Courierr that Penumbra and EnergyPlus use, for programs that do
// not have Courierr.

namespace Courierr {

class Courierr {
 public:
  virtual ~Courierr() = default;

  virtual void error(const std::string_view message) = 0;
  virtual void warning(const std::string_view message) = 0;
  virtual void info(const std::string_view message) = 0;
  virtual void debug(const std::string_view message) = 0;

  // Passed on to loggers that know what it is.
  void set_message_context(void* context) { message_context = context; }

 protected:
  void* message_context = nullptr;
};

// Tells the logger when it is thrown.
class CourierrException : public std::exception {
 public:
  explicit CourierrException(const std::string_view text, Courierr& logger) : message(text) {
    logger.error(message);
  }

  char const* what() const noexcept override { return message.c_str(); }

 protected:
  std::string message;
};

}  // namespace Courierr

#endif
