#include "routes/patched/memory/sky_ratios.h"

#include <algorithm>

#include "routes/patched/memory/safe_read.h"

namespace gpu_shading::energyplus {
namespace {

struct Values {
  double* data;
  std::size_t size;
};

Values read_values(std::byte const* at) {
  auto const header = read_value<ArrayHeader>(at);
  expect(header && header->size <= header->capacity && header->data != nullptr);
  Values const values{reinterpret_cast<double*>(header->data), header->size};
  // Both ends can be read.
  expect(values.size > 0 && read_value<double>(values.data) &&
         read_value<double>(values.data + values.size - 1));
  return values;
}

}  // namespace

std::optional<SkyRatios> SkyRatios::find(State& state, SymbolTable const& symbols) {
  try {
    SkyRatios found;
    auto const* const object = find_object(state, symbol::solar_shading_data.in(symbols));
    auto const words = words_of_block(object);
    for (std::size_t i = 0; i < words.size(); ++i) {
      if (words[i] != symbol::numbers_3.in(symbols)) continue;
      auto const* const at = object + i * sizeof(void*);
      auto const [data, size] = read_values(at);
      // Rounding may make them a little larger than 1.
      constexpr double most = 1.001;
      expect(std::all_of(data, data + size, [](double one) { return one >= 0.0 && one <= most; }));
      found.arrays_.push_back({at, {data, data + size}});
    }
    // Of the whole sky and of its horizon.
    expect(found.arrays_.size() == 2 &&
           found.arrays_[0].values.size() == found.arrays_[1].values.size());
    return found;
  } catch (Unexpected const&) {
    return std::nullopt;
  }
}

bool SkyRatios::restore() const {
  try {
    std::vector<double*> places;
    for (auto const& [at, values] : arrays_) {
      auto const [data, size] = read_values(at);
      expect(size == values.size());
      expect(std::all_of(data, data + size, [](double one) { return one == 1.0; }));
      places.push_back(data);
    }
    for (std::size_t i = 0; i < places.size(); ++i) {
      std::ranges::copy(arrays_[i].values, places[i]);
    }
    return true;
  } catch (Unexpected const&) {
    return false;
  }
}

}  // namespace gpu_shading::energyplus
