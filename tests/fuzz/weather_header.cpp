#include "model/site/weather_header.h"

#include "fuzz.h"
#include "model/site/site_clock.h"

extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size) {
  using namespace gpu_shading::energyplus;
  auto const weather = file_of(as_text(data, size), "weather.epw");
  try_to([&] { read_weather_site(weather); });
  std::optional<std::pair<std::string, std::string>> saving;
  try_to([&] { saving = read_daylight_saving(weather); });
  // What is not refused must be days.
  if (saving) {
    using namespace std::chrono_literals;
    date_in(saving->first, 2017y);
    date_in(saving->second, 2017y);
  }
  return 0;
}
