#include "routes/patched/memory/solar_reflections.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <set>
#include <string>

#include "routes/patched/memory/safe_read.h"

namespace gpu_shading::energyplus {

namespace {

using std::numbers::pi;

// EnergyPlus's DataEnvironment::SunIsUpValue.
constexpr double sun_is_up_value = 1e-5;

}  // namespace

SolarReflections::SolarReflections(ReflectionMemory memory, Session& session,
                                   ReflectionFunctions const& original)
    : memory_(std::move(memory)),
      session_(session),
      original_(original),
      is_mirror_(find_mirrors()) {
  for (auto const& receiver : memory_.receivers) {
    if (!session_.is_placeholder(receiver.surface)) continue;
    // EnergyPlus computes nothing for it.
    *receiver.ray_count = 0;
    *receiver.obstruction_count = 0;
  }
  hidden().set_rays(rays());
}

// Calls visit(receiver, point, ray) for each ray from each point.
template <typename Visit>
void SolarReflections::for_each_ray(Visit const& visit) const {
  for (auto const& receiver : memory_.receivers) {
    auto const points = static_cast<std::size_t>(*receiver.point_count);
    auto const rays = static_cast<std::size_t>(*receiver.ray_count);
    for (std::size_t point = 0; point < points; ++point) {
      for (std::size_t ray = 0; ray < rays; ++ray) visit(receiver, point, ray);
    }
  }
}

std::vector<ReflectionRay> SolarReflections::rays() const {
  std::vector<ReflectionRay> all;
  for_each_ray([&](Receiver const& receiver, std::size_t point, std::size_t ray) {
    ReflectionRay made;
    made.origin = receiver.points[point];
    made.direction = receiver.directions[ray];
    std::size_t const at = ray * memory_.row + point;
    auto const number = receiver.hit_numbers[at];
    if (number != 0) {
      made.meets = number < 0 ? ReflectionRay::Meets::ground : ReflectionRay::Meets::surface;
      made.hit = receiver.hits[at];
      made.distance = receiver.hit_distances[at];
    }
    all.push_back(made);
  });
  return all;
}

std::optional<glm::dvec3> SolarReflections::sun(int hour) const {
  auto const& direction = *memory_.suns.at(static_cast<std::size_t>(hour - 1));
  if (direction.z < sun_is_up_value) return std::nullopt;
  return glm::normalize(direction);
}

void SolarReflections::weaken(std::vector<ReflectedShare> const& shares, Edits& edits) const {
  std::size_t i = 0;
  for_each_ray([&](Receiver const& receiver, std::size_t point, std::size_t ray) {
    double const kept = shares[i++].kept;
    std::size_t const at = ray * memory_.row + point;
    if (kept >= 1.0 || receiver.hit_numbers[at] == 0) return;
    if (kept <= 0.0) {
      edits.set(&receiver.hit_numbers[at], 0);
    } else {
      edits.set(&receiver.hit_reflectances[at], receiver.hit_reflectances[at] * kept);
    }
  });
}

void SolarReflections::add(std::vector<ReflectedShare> const& shares, DiffuseResults const& results,
                           std::size_t offset) const {
  std::size_t i = 0;
  for (auto const& receiver : memory_.receivers) {
    double shades = 0.0;
    double ground = 0.0;
    auto const points = static_cast<std::size_t>(*receiver.point_count);
    auto const rays = static_cast<std::size_t>(*receiver.ray_count);
    for (std::size_t point = 0; point < points; ++point) {
      for (std::size_t ray = 0; ray < rays; ++ray) {
        auto const& share = shares[i++];
        double const weight = receiver.solid_angles[ray] * receiver.cosines[ray] / pi;
        shades += weight * share.shades;
        ground += weight * share.ground;
      }
    }
    std::size_t const at = offset + static_cast<std::size_t>(receiver.number - 1);
    auto const count = static_cast<double>(points);
    results.shades[at] += shades / count;
    if (ground <= 0.0) continue;
    // As in EnergyPlus, not more than an unobstructed ground.
    double const max_ground = 0.5 * (1.0 - receiver.normal.z);
    results.ground[at] =
        std::max(results.ground[at], std::min(max_ground, results.ground[at] + ground / count));
  }
}

// Calls EnergyPlus's function with what hidden casters leave of its rays, and adds what they
// reflect.
template <typename Call>
void SolarReflections::count(std::vector<ReflectedShare> const& shares,
                             DiffuseResults const& results, std::size_t offset,
                             Call const& call) const {
  {
    Edits edits;
    weaken(shares, edits);
    call();
  }
  add(shares, results, offset);
}

bool SolarReflections::beam_diffuse(State& state, int hour) {
  auto const to_sun = sun(hour);
  if (!to_sun) {
    original_.beam_diffuse(state, hour);
    return true;
  }
  std::size_t const offset = memory_.at(hour, 1);
  if (!beam_) {
    beam_ = find_diffuse_results(memory_, memory_.by_hour, offset, *to_sun,
                                 [&] { original_.beam_diffuse(state, hour); });
  }
  if (!beam_) {
    original_.beam_diffuse(state, hour);
    return false;
  }
  hidden().renew();
  auto const& shares = hidden().beam({hour, *to_sun, session_.first_sun(hour)});
  count(shares, *beam_, offset, [&] { original_.beam_diffuse(state, hour); });
  return true;
}

bool SolarReflections::sky_diffuse(State& state) {
  if (!sky_) {
    constexpr glm::dvec3 up{0.0, 0.0, 1.0};
    sky_ = find_diffuse_results(memory_, memory_.by_surface, 0, up,
                                [&] { original_.sky_diffuse(state); });
  }
  if (!sky_) {
    original_.sky_diffuse(state);
    return false;
  }
  auto const& shares = hidden().sky();
  count(shares, *sky_, 0, [&] { original_.sky_diffuse(state); });
  return true;
}

// By number, whether EnergyPlus reflects the beam in a surface: in windows, doors among them, and
// in shading surfaces with a glazed fraction and their copies.
std::vector<bool> SolarReflections::find_mirrors() const {
  std::set<std::string> names;
  auto const& input = session_.input();
  for (auto const& [name, base] : input.base_of) names.insert(name);
  for (auto const& [name, properties] : input.shading_surfaces) {
    if (properties.glazed > 0.0) names.insert({name, mirrored_name(name)});
  }
  std::vector<bool> mirrors;
  for (auto const& id : memory_.ids) {
    mirrors.push_back(id && names.contains(session_.surface(*id).name));
  }
  return mirrors;
}

bool SolarReflections::is_mirror(std::int32_t number) const {
  return is_mirror_[static_cast<std::size_t>(number)];
}

RayScene const& SolarReflections::mirror(SurfaceId surface) {
  auto const found = mirrors_.find(surface);
  if (found != mirrors_.end()) return found->second;
  Scene scene;
  scene.add({"", session_.surface(surface).polygon});
  return mirrors_.emplace(surface, RayScene(scene, {.faces = RayFaces::both})).first->second;
}

std::vector<SurfaceId> SolarReflections::mirrors_of(std::int32_t window) const {
  std::vector<SurfaceId> found;
  for (auto const& receiver : memory_.receivers) {
    if (receiver.number != window) continue;
    for (std::int32_t i = 0; i < *receiver.obstruction_count; ++i) {
      auto const number = receiver.obstructions[i];
      if (is_mirror(number)) found.push_back(*memory_.ids[static_cast<std::size_t>(number)]);
    }
  }
  return found;
}

std::optional<double> SolarReflections::distance_to_mirror(SurfaceId surface, Ray const& ray) {
  auto const met = mirror(surface).layers(ray);
  if (met.empty()) return std::nullopt;
  return met.front().distance;
}

std::vector<SolarReflections::Image> SolarReflections::images(Receiver const& receiver,
                                                              glm::dvec3 const& to_sun, int hour) {
  std::vector<Image> found;
  for (std::int32_t i = 0; i < *receiver.obstruction_count; ++i) {
    auto const number = receiver.obstructions[i];
    if (!is_mirror(number)) continue;
    auto const id = *memory_.ids[static_cast<std::size_t>(number)];
    auto const facing = normal(session_.surface(id).polygon);
    if (glm::dot(to_sun, facing) < 0.0) continue;
    auto const to_image = to_sun - 2.0 * glm::dot(to_sun, facing) * facing;
    if (glm::dot(receiver.normal, to_image) <= 0.0) continue;
    for (std::size_t point = 0; point < static_cast<std::size_t>(*receiver.point_count); ++point) {
      auto const& from = receiver.points[point];
      auto const distance = distance_to_mirror(id, {from, to_image});
      if (!distance) continue;
      auto const at = from + *distance * to_image;
      double passed = hidden().transmittance({from, to_image, *distance}, hour);
      if (passed > 0.0) passed *= hidden().transmittance({at, to_sun}, hour);
      found.push_back({point, number, passed});
    }
  }
  return found;
}

bool SolarReflections::beam_specular(State& state, int hour) {
  auto const to_sun = sun(hour);
  if (to_sun && !specular_pair_) {
    specular_pair_ =
        find_specular_results(memory_, hour, [&] { original_.beam_specular(state, hour); });
    if (!specular_pair_) {
      original_.beam_specular(state, hour);
      return false;
    }
  }
  original_.beam_specular(state, hour);
  if (!to_sun) return true;
  for (auto const& receiver : memory_.receivers) {
    auto const seen = images(receiver, *to_sun, hour);
    bool const free =
        std::ranges::all_of(seen, [](Image const& image) { return image.passed >= 1.0; });
    if (!free && !reflect_again(state, hour, receiver, *to_sun, seen)) return false;
  }
  return true;
}

// Has EnergyPlus compute what each mirror reflects to each point, and adds that up as it does.
bool SolarReflections::reflect_again(State& state, int hour, Receiver const& receiver,
                                     glm::dvec3 const& to_sun, std::vector<Image> const& images) {
  std::size_t const at = memory_.at(hour, receiver.number);
  auto const [one, other] = *specular_pair_;
  if (one[at] == 0.0 && other[at] == 0.0) return true;  // others stop it already
  std::vector<std::int32_t> blocking;
  for (std::int32_t i = 0; i < *receiver.obstruction_count; ++i) {
    if (!is_mirror(receiver.obstructions[i])) blocking.push_back(receiver.obstructions[i]);
  }
  struct Sum {
    double factor = 0.0;
    double times_cosine = 0.0;
  };
  std::vector<Sum> sums(static_cast<std::size_t>(*receiver.point_count));
  for (auto const& image : images) {
    if (image.passed <= 0.0) continue;
    Edits edits;
    for (auto const& each : memory_.receivers) edits.set(each.obstruction_count, 0);
    edits.set(receiver.obstruction_count, static_cast<std::int32_t>(blocking.size() + 1));
    edits.set(&receiver.obstructions[0], image.mirror);
    for (std::size_t i = 0; i < blocking.size(); ++i) {
      edits.set(&receiver.obstructions[i + 1], blocking[i]);
    }
    edits.set(receiver.point_count, 1);
    edits.set(&receiver.points[0], receiver.points[image.point]);
    edits.set(&one[at], 0.0);
    edits.set(&other[at], 0.0);
    original_.beam_specular(state, hour);
    if (one[at] == 0.0 && other[at] == 0.0) continue;
    auto const id = *memory_.ids[static_cast<std::size_t>(image.mirror)];
    auto const facing = normal(session_.surface(id).polygon);
    double const cosine =
        glm::dot(receiver.normal, to_sun - 2.0 * glm::dot(to_sun, facing) * facing);
    // EnergyPlus hands over vertices in single precision.
    auto const is_cosine = [&](double value) { return std::abs(value - cosine) < 1e-4; };
    if (!specular_) {
      // The factor is the cosine times a reflectance below 1.
      if (is_cosine(other[at]) && one[at] < other[at]) specular_ = {one, other};
      if (is_cosine(one[at]) && other[at] < one[at]) specular_ = {other, one};
    }
    if (!specular_ || !is_cosine(specular_->cosine[at])) return false;
    double const factor = image.passed * specular_->factor[at];
    auto& sum = sums[image.point];
    sum.factor += factor;
    sum.times_cosine += factor * specular_->cosine[at];
  }
  double factor = 0.0;
  double cosine = 0.0;
  for (auto const& sum : sums) {
    factor += sum.factor;
    if (sum.factor > 0.0) cosine += sum.times_cosine / sum.factor;
  }
  auto const count = static_cast<double>(*receiver.point_count);
  if (specular_) {
    specular_->factor[at] = factor / count;
    specular_->cosine[at] = cosine / count;
  } else {
    one[at] = other[at] = 0.0;  // hidden casters stop all
  }
  return true;
}

}  // namespace gpu_shading::energyplus
