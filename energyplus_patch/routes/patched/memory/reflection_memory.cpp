#include "routes/patched/memory/reflection_memory.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <span>
#include <string>

#include "routes/patched/memory/safe_read.h"

namespace gpu_shading::energyplus {
namespace {

// Where arrays begin in an object, in order.
struct Place {
  std::size_t offset;
  std::byte const* table;
};
std::vector<Place> arrays_in(std::vector<std::byte const*> const& words,
                             ReflectionClasses const& classes) {
  std::vector<Place> places;
  for (std::size_t i = 0; i < words.size(); ++i) {
    for (auto const* table : {classes.receivers, classes.vectors, classes.numbers, classes.integers,
                              classes.vectors_2, classes.numbers_2, classes.integers_2}) {
      if (words[i] == table) places.push_back({i * sizeof(void*), table});
    }
  }
  return places;
}

// Places of arrays in EnergyPlus's SolReflRecSurfData.
enum Member : std::size_t {
  points,
  directions,
  cosines,
  solid_angles,
  hits,
  hit_numbers,
  hit_reflectances,
  hit_distances,
  hit_normals,
  obstructions,
  members
};

// How the elements of EnergyPlus's array of receivers are made.
struct Layout {
  std::byte* first = nullptr;
  std::size_t count = 0;
  std::size_t stride = 0;
  std::array<std::size_t, members> arrays{};
  std::size_t number = 0;
  std::size_t name = 0;
  std::size_t point_count = 0;
  std::size_t ray_count = 0;
  std::size_t obstruction_count = 0;

  std::byte* element(std::size_t index) const { return first + index * stride; }
};

constexpr std::size_t string_size = sizeof(std::string);

// A std::string of EnergyPlus's, if there is one of a name's length.
std::optional<std::string> read_string(std::byte const* at) {
  constexpr std::uint64_t longest = 1000;
  auto const text = read_value<char const*>(at);
  auto const length = read_value<std::uint64_t>(at + sizeof(char const*));
  if (!text || !length || *length == 0 || *length > longest) return std::nullopt;
  std::string value(*length, '\0');
  if (!read_memory(*text, value.data(), value.size())) return std::nullopt;
  return value;
}

std::int32_t read_integer(std::byte const* at) {
  auto const value = read_value<std::int32_t>(at);
  expect(value.has_value());
  return *value;
}

// The last place from `begin` to `end` at which every element has an integer as expected.
template <typename Expected>
std::size_t find_integer(Layout const& layout, std::size_t begin, std::size_t end,
                         Expected const& expected) {
  for (std::size_t at = end; at >= begin + sizeof(std::int32_t);) {
    at -= sizeof(std::int32_t);
    bool all = true;
    for (std::size_t i = 0; all && i < layout.count; ++i) {
      all = expected(layout.element(i), read_integer(layout.element(i) + at));
    }
    if (all) return at;
  }
  throw Unexpected{};
}

void find_arrays(std::byte const* manager, ReflectionClasses const& classes, Layout& layout) {
  auto const places = arrays_in(words_of_block(manager), classes);
  auto const found = std::ranges::find_if(
      places, [&](Place const& place) { return place.table == classes.receivers; });
  expect(found != places.end());
  auto const header = read_value<ArrayHeader>(manager + found->offset);
  expect(header && header->size > 0 && header->data != nullptr && header->shift == 1);
  layout.first = header->data;
  layout.count = header->size;

  std::array<std::byte const*, members> const expected{
      classes.vectors,   classes.vectors,    classes.numbers,   classes.numbers,
      classes.vectors_2, classes.integers_2, classes.numbers_2, classes.numbers_2,
      classes.vectors_2, classes.integers};
  constexpr std::size_t largest = 0x1000;
  auto const in_element = arrays_in(words_of(layout.first, 2 * largest), classes);
  expect(in_element.size() >= members + (layout.count > 1 ? 1 : 0));
  for (std::size_t i = 0; i < members; ++i) {
    expect(in_element[i].table == expected[i]);
    layout.arrays[i] = in_element[i].offset;
  }
  expect(layout.arrays[members - 1] < largest);
  // The last one's bounds and the count that follows it.
  constexpr std::size_t after_last = 2 * sizeof(ArrayHeader);
  layout.stride = layout.count > 1 ? in_element[members].offset - layout.arrays[0]
                                   : layout.arrays[members - 1] + after_last;
  for (std::size_t i = 0; i < layout.count; ++i) {
    for (std::size_t member = 0; member < members; ++member) {
      expect(read_value<std::byte const*>(layout.element(i) + layout.arrays[member]) ==
             expected[member]);
    }
  }
}

// The place of the number and the name, from the ids of the surfaces that were handed over.
void find_name(Layout& layout, Session const& session,
               std::vector<std::optional<SurfaceId>> const& ids) {
  auto const fits = [&](std::size_t number_at, std::size_t name_at) {
    for (std::size_t i = 0; i < layout.count; ++i) {
      auto const number = read_integer(layout.element(i) + number_at);
      if (number < 1 || static_cast<std::size_t>(number) >= ids.size()) return false;
      auto const id = ids[static_cast<std::size_t>(number)];
      if (!id || read_string(layout.element(i) + name_at) != session.surface(*id).name) {
        return false;
      }
    }
    return true;
  };
  std::size_t const end = layout.arrays[points];
  for (std::size_t name = 0; name + string_size <= end; name += sizeof(void*)) {
    if (!read_string(layout.element(0) + name)) continue;
    for (std::size_t number = 0; number < end; number += sizeof(std::int32_t)) {
      if (number + sizeof(std::int32_t) > name && number < name + string_size) continue;
      if (!fits(number, name)) continue;
      layout.number = number;
      layout.name = name;
      return;
    }
  }
  throw Unexpected{};
}

bool is_unit(glm::dvec3 const& vector) { return std::abs(glm::length(vector) - 1.0) < 1e-6; }

void find_counts(Layout& layout) {
  auto const array_of = [&](std::byte const* element, Member member) {
    return element + layout.arrays[member];
  };
  auto const max_count =
      static_cast<std::int32_t>(read_array<glm::dvec3>(array_of(layout.first, points)).size);
  layout.point_count = find_integer(
      layout, layout.name + string_size, layout.arrays[points],
      [&](std::byte const*, std::int32_t value) { return value >= 3 && value <= max_count; });
  auto const end_of = [&](Member member) { return layout.arrays[member] + sizeof(ArrayHeader); };
  layout.ray_count = find_integer(
      layout, end_of(points), layout.arrays[directions],
      [&](std::byte const* element, std::int32_t value) {
        auto const rays = read_array<glm::dvec3>(array_of(element, directions));
        std::span const all(rays.data, rays.size);
        auto const units = std::find_if_not(all.begin(), all.end(), is_unit);
        return value == units - all.begin() &&
               std::all_of(units, all.end(), [](auto const& ray) { return ray == glm::dvec3(0); });
      });
  layout.obstruction_count =
      find_integer(layout, end_of(obstructions), layout.stride,
                   [&](std::byte const* element, std::int32_t value) {
                     auto const numbers = read_array<std::int32_t>(array_of(element, obstructions));
                     std::span const all(numbers.data, numbers.size);
                     return value == std::ranges::find(all, 0) - all.begin();
                   });
}

ReflectionMemory::Receiver read_receiver(Layout const& layout, std::size_t index,
                                         Session const& session, ReflectionMemory& memory) {
  std::byte* const element = layout.element(index);
  ReflectionMemory::Receiver receiver;
  receiver.number = read_integer(element + layout.number);
  receiver.surface = *memory.ids[static_cast<std::size_t>(receiver.number)];
  receiver.normal = normal(session.surface(receiver.surface).polygon);
  receiver.point_count = reinterpret_cast<std::int32_t*>(element + layout.point_count);
  receiver.ray_count = reinterpret_cast<std::int32_t*>(element + layout.ray_count);
  receiver.obstruction_count = reinterpret_cast<std::int32_t*>(element + layout.obstruction_count);

  auto const point_array = read_array<glm::dvec3>(element + layout.arrays[points]);
  auto const direction_array = read_array<glm::dvec3>(element + layout.arrays[directions]);
  std::size_t const rays = direction_array.size;
  receiver.points = point_array.data;
  receiver.directions = direction_array.data;
  auto const by_ray = [&](Member member) {
    auto const array = read_array<double>(element + layout.arrays[member]);
    expect(array.size == rays);
    return array.data;
  };
  receiver.cosines = by_ray(cosines);
  receiver.solid_angles = by_ray(solid_angles);
  memory.row = point_array.size;
  auto const by_ray_and_point = [&]<typename Element>(Member member, Element*& data) {
    auto const array = read_array<Element>(element + layout.arrays[member], true);
    expect(array.row == memory.row && array.size == rays * array.row);
    data = array.data;
  };
  by_ray_and_point(hits, receiver.hits);
  by_ray_and_point(hit_numbers, receiver.hit_numbers);
  by_ray_and_point(hit_reflectances, receiver.hit_reflectances);
  by_ray_and_point(hit_distances, receiver.hit_distances);
  by_ray_and_point(hit_normals, receiver.hit_normals);
  auto const numbers = read_array<std::int32_t>(element + layout.arrays[obstructions]);
  expect(numbers.size == static_cast<std::size_t>(memory.surfaces));
  receiver.obstructions = numbers.data;
  expect(*receiver.obstruction_count <= memory.surfaces);
  expect(*receiver.point_count <= static_cast<std::int32_t>(memory.row));
  expect(*receiver.ray_count >= 1);
  return receiver;
}

// Whether rays, distances and normals belong together.
void check(ReflectionMemory::Receiver const& receiver, ReflectionMemory const& memory) {
  // EnergyPlus hands over vertices in single precision.
  constexpr double tolerance = 1e-3;
  auto const near = [&](double a, double b) { return std::abs(a - b) < tolerance; };
  for (std::size_t ray = 0; ray < static_cast<std::size_t>(*receiver.ray_count); ++ray) {
    expect(near(glm::dot(receiver.directions[ray], receiver.normal), receiver.cosines[ray]));
    expect(receiver.solid_angles[ray] > 0.0 && receiver.solid_angles[ray] < 1.0);
    for (std::size_t point = 0; point < static_cast<std::size_t>(*receiver.point_count); ++point) {
      std::size_t const at = ray * memory.row + point;
      auto const number = receiver.hit_numbers[at];
      expect(number >= -1 && number <= memory.surfaces);
      if (number == 0) continue;
      double const distance = receiver.hit_distances[at];
      auto const expected = receiver.points[point] + distance * receiver.directions[ray];
      expect(glm::length(expected - receiver.hits[at]) < tolerance * (1.0 + distance));
      expect(is_unit(receiver.hit_normals[at]));
      expect(receiver.hit_reflectances[at] >= 0.0 && receiver.hit_reflectances[at] <= 1.0);
    }
  }
}

void find_in_surfaces(std::byte const* object, ReflectionClasses const& classes,
                      ReflectionMemory& memory) {
  constexpr std::size_t hours = 24;
  auto const all = static_cast<std::size_t>(memory.surfaces);
  bool suns = false;
  for (auto const& place : arrays_in(words_of_block(object), classes)) {
    auto const header = read_value<ArrayHeader>(object + place.offset);
    expect(header.has_value());
    if (place.table == classes.numbers && header->size == all && header->shift == 1) {
      memory.by_surface.push_back(read_array<double>(object + place.offset).data);
    } else if (place.table == classes.numbers_2 && header->size == hours * all &&
               header->shift == static_cast<std::int64_t>(all) + 1) {
      memory.by_hour.push_back(read_array<double>(object + place.offset, true).data);
    } else if (place.table == classes.vectors && header->size == hours && header->shift == 1) {
      expect(!suns);  // there is one of that size
      suns = true;
      auto const array = read_array<glm::dvec3>(object + place.offset);
      for (std::size_t hour = 0; hour < hours; ++hour) memory.suns[hour] = array.data + hour;
    }
  }
  expect(suns);
}

}  // namespace

std::optional<ReflectionMemory> find_reflection_memory(State& state, Session const& session,
                                                       StoredResult const& ids,
                                                       ReflectionClasses const& classes) {
  try {
    Layout layout;
    find_arrays(find_object(state, classes.manager), classes, layout);
    ReflectionMemory memory;
    memory.surfaces = static_cast<std::int32_t>(
        read_array<std::int32_t>(layout.first + layout.arrays[obstructions]).size);
    memory.ids = read_surface_ids(state, ids, memory.surfaces, session);
    find_name(layout, session, memory.ids);
    find_counts(layout);
    for (std::size_t i = 0; i < layout.count; ++i) {
      memory.receivers.push_back(read_receiver(layout, i, session, memory));
      check(memory.receivers.back(), memory);
    }
    find_in_surfaces(find_object(state, classes.surfaces), classes, memory);
    return memory;
  } catch (Unexpected const&) {
    return std::nullopt;
  }
}

}  // namespace gpu_shading::energyplus
