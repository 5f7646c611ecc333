#include "routes/patched/memory/sky_multipliers.h"

#include <algorithm>
#include <optional>
#include <vector>

#include "routes/patched/memory/safe_read.h"

namespace gpu_shading::energyplus {
namespace {

std::optional<std::span<double>> numbers_at(std::byte const* at) {
  auto const header = read_value<ArrayHeader>(at);
  if (!header || header->size == 0 || header->size > header->capacity) return std::nullopt;
  auto* const first = reinterpret_cast<double*>(header->data);
  if (!read_value<double>(first) || !read_value<double>(first + header->size - 1)) {
    return std::nullopt;
  }
  return std::span(first, header->size);
}

struct Array {
  std::byte* at;
  std::span<double> numbers;
  std::vector<double> before;
  bool by_surface;
};

}  // namespace

std::byte* find_sky_multipliers(State& state, SymbolTable const& symbols,
                                std::function<void()> const& call) {
  try {
    std::vector<Array> arrays;
    auto* const object = find_object(state, symbol::solar_shading_data.in(symbols));
    auto const words = words_of_block(object);
    for (std::size_t i = 0; i < words.size(); ++i) {
      bool const by_surface = words[i] == symbol::numbers.in(symbols);
      if (!by_surface && words[i] != symbol::numbers_3.in(symbols)) continue;
      auto* const at = object + i * sizeof(void*);
      auto const numbers = numbers_at(at);
      if (numbers) arrays.push_back({at, *numbers, {numbers->begin(), numbers->end()}, by_surface});
    }
    auto const results_with = [&](double mark) {
      for (auto const& array : arrays) std::ranges::fill(array.numbers, mark);
      call();
      std::vector<std::vector<double>> results;
      results.reserve(arrays.size());
      for (auto const& array : arrays) {
        results.emplace_back(array.numbers.begin(), array.numbers.end());
      }
      return results;
    };
    constexpr double half = 0.5;
    auto const dark = results_with(0.0);
    auto const lit = results_with(half);
    for (auto const& array : arrays) std::ranges::copy(array.before, array.numbers.begin());
    std::byte* found = nullptr;
    for (std::size_t i = 0; i < arrays.size(); ++i) {
      if (!arrays[i].by_surface) continue;
      for (std::size_t k = 0; k < lit[i].size(); ++k) {
        if (lit[i][k] == half || lit[i][k] == dark[i][k]) continue;
        expect(found == nullptr || found == arrays[i].at);
        found = arrays[i].at;
      }
    }
    return found;
  } catch (Unexpected const&) {
    return nullptr;
  }
}

std::span<double> sky_multipliers_at(std::byte const* array) {
  return numbers_at(array).value_or(std::span<double>());
}

}  // namespace gpu_shading::energyplus
