// CPU time of one core per sun direction at meeting a target error, of the renderer and of rays
// traced by Embree, one at a time and in packets of 16.

#include <embree3/rtcore.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <memory>
#include <optional>
#include <random>
#include <string_view>
#include <type_traits>
#include <vector>

#include "gpu_shading/error.h"
#include "gpu_shading/sun_direction.h"
#include "platform/parallel.h"
#include "support/crowds.h"
#include "support/processor_time.h"
#include "support/shapes.h"
#include "table_main.h"

namespace gpu_shading {
namespace {

constexpr int directions = 100;
constexpr double window_width = 3.0;
constexpr double window_height = 2.0;

// Spread over the southern sky by the golden ratio.
SunDirection direction(int i) {
  return sun_at(100.0 + 160.0 * i / directions, 6.0 + 60.0 * std::fmod(i * 0.618034, 1.0));
}

Scene window() {
  Scene scene;
  scene.add({"window", south_facing(0, 0, 0, window_width, window_height)});
  return scene;
}

// Leaves that cover half of a box as seen from one side.
Scene leaves(int count) {
  Scene scene = window();
  std::mt19937 generator{1};
  auto const between = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(generator);
  };
  double const side = std::sqrt(0.5 * 4.0 * 4.5 / count);
  for (int i = 0; i < count; ++i) {
    double const x = between(-0.5, 3.5);
    double const y = between(-2.0, -0.2);
    double const z = between(-0.5, 4.0);
    double const turn = between(-0.5, 0.5);
    scene.add({"leaf", parallelogram({x, y, z}, {side, side * turn, 0}, {0, 0, side})});
  }
  return scene;
}

// Buildings on a grid of streets, each with four walls and a roof, and the window in one of them.
Scene city(int buildings) {
  Scene scene = window();
  std::mt19937 generator{1};
  auto const between = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(generator);
  };
  int const across = static_cast<int>(std::ceil(std::sqrt(buildings)));
  for (int i = 0; i < buildings; ++i) {
    auto const place = std::div(i, across);
    int const from_middle = place.rem - across / 2;
    double const x = 25.0 * from_middle + between(0.0, 5.0);
    double const y = -20.0 - 25.0 * place.quot + between(0.0, 5.0);
    double const width = between(8.0, 15.0);
    double const depth = between(8.0, 15.0);
    double const height = between(4.0, 30.0);
    scene.add({"south", parallelogram({x, y, 0}, {width, 0, 0}, {0, 0, height})});
    scene.add({"north", parallelogram({x + width, y + depth, 0}, {-width, 0, 0}, {0, 0, height})});
    scene.add({"west", parallelogram({x, y + depth, 0}, {0, -depth, 0}, {0, 0, height})});
    scene.add({"east", parallelogram({x + width, y, 0}, {0, depth, 0}, {0, 0, height})});
    scene.add({"roof", level(x, y, height, width, depth)});
  }
  return scene;
}

struct Result {
  double milliseconds = 0.0;  // a direction
  std::vector<double> fractions;
};

double percentile_99(std::vector<double> const& fractions, std::vector<double> const& exact) {
  std::vector<double> errors;
  for (std::size_t i = 0; i < exact.size(); ++i) {
    errors.push_back(std::abs(fractions[i] - exact[i]));
  }
  std::sort(errors.begin(), errors.end());
  return errors[errors.size() * 99 / 100 - 1];
}

Result rendered(Scene const& scene, RendererOptions const& options) {
  Renderer renderer(scene, options);
  sunlit(renderer, sun_at(180, 45), 0);  // lays out the receiver's tile
  std::vector<SunDirection> suns;
  suns.reserve(directions);
  for (int i = 0; i < directions; ++i) suns.push_back(direction(i));
  SurfaceId const receiver = 0;
  double const before = processor_seconds();
  auto const answers = renderer.projected_sunlit_areas(suns, {&receiver, 1});
  Result result;
  result.milliseconds = 1e3 * (processor_seconds() - before) / directions;
  for (int i = 0; i < directions; ++i) {
    double const cosine = -to_vector(direction(i)).y;
    result.fractions.push_back(answers[static_cast<std::size_t>(i)].front().projected_area /
                               (cosine * window_width * window_height));
  }
  return result;
}

constexpr int max_rays = 1 << 20;

// Points on the window, spread by Roberts' R2 sequence.
std::vector<glm::vec2> const& origins() {
  static std::vector<glm::vec2> const points = [] {
    constexpr double plastic = 1.32471795724474602596;
    std::vector<glm::vec2> made;
    made.reserve(max_rays);
    for (int i = 0; i < max_rays; ++i) {
      made.emplace_back(window_width * std::fmod(0.5 + i / plastic, 1.0),
                        window_height * std::fmod(0.5 + i / (plastic * plastic), 1.0));
    }
    return made;
  }();
  return points;
}

// The scene's quadrilaterals in Embree.
class Peer {
 public:
  explicit Peer(Scene const& scene)
      : device_(rtcNewDevice("threads=1")), scene_(rtcNewScene(device_.get())) {
    RTCGeometry const geometry = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_QUAD);
    std::size_t const count = scene.size() - 1;
    auto* const vertices = static_cast<float*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 12, 4 * count));
    auto* const indices = static_cast<unsigned*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT4, 16, count));
    for (std::size_t i = 0; i < count; ++i) {
      for (std::size_t corner = 0; corner < 4; ++corner) {
        std::size_t const vertex = 4 * i + corner;
        glm::dvec3 const place = scene[static_cast<SurfaceId>(i + 1)].polygon.outline[corner];
        for (int axis = 0; axis < 3; ++axis) {
          vertices[3 * vertex + static_cast<std::size_t>(axis)] = static_cast<float>(place[axis]);
        }
        indices[vertex] = static_cast<unsigned>(vertex);
      }
    }
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_.get(), geometry);
    rtcReleaseGeometry(geometry);
    rtcSetSceneBuildQuality(scene_.get(), RTC_BUILD_QUALITY_HIGH);
    rtcCommitScene(scene_.get());
    if (rtcGetDeviceError(device_.get()) != RTC_ERROR_NONE) throw Error("Embree failed");
  }

  // By so many rays, a multiple of 16.
  Result traced(int rays, bool packets) const {
    Result result;
    origins();
    double const before = processor_seconds();
    for (int i = 0; i < directions; ++i) {
      glm::dvec3 const sun = to_vector(direction(i));
      int const met = packets ? met_by_packets(rays, sun) : met_by_rays(rays, sun);
      result.fractions.push_back(1.0 - static_cast<double>(met) / rays);
    }
    result.milliseconds = 1e3 * (processor_seconds() - before) / directions;
    return result;
  }

 private:
  static constexpr int packet = 16;

  struct Release {
    void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
    void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
  };

  int met_by_rays(int rays, glm::vec3 const& sun) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    int met = 0;
    for (int i = 0; i < rays; ++i) {
      glm::vec2 const from = origins()[static_cast<std::size_t>(i)];
      RTCRay ray{};
      ray.org_x = from.x;
      ray.org_z = from.y;
      ray.dir_x = sun.x;
      ray.dir_y = sun.y;
      ray.dir_z = sun.z;
      ray.tfar = std::numeric_limits<float>::infinity();
      ray.mask = ~0U;
      rtcOccluded1(scene_.get(), &context, &ray);
      if (ray.tfar < 0.0F) ++met;
    }
    return met;
  }

  int met_by_packets(int rays, glm::vec3 const& sun) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    alignas(64) std::array<int, packet> valid;
    valid.fill(-1);
    int met = 0;
    for (int first = 0; first < rays; first += packet) {
      RTCRay16 some{};
      for (int k = 0; k < packet; ++k) {
        auto const ray = static_cast<std::size_t>(first) + static_cast<std::size_t>(k);
        glm::vec2 const from = origins()[ray];
        some.org_x[k] = from.x;
        some.org_z[k] = from.y;
        some.dir_x[k] = sun.x;
        some.dir_y[k] = sun.y;
        some.dir_z[k] = sun.z;
        some.tfar[k] = std::numeric_limits<float>::infinity();
        some.mask[k] = ~0U;
      }
      rtcOccluded16(valid.data(), scene_.get(), &context, &some);
      for (float const far : some.tfar) met += far < 0.0F ? 1 : 0;
    }
    return met;
  }

  std::unique_ptr<std::remove_pointer_t<RTCDevice>, Release> device_;
  std::unique_ptr<std::remove_pointer_t<RTCScene>, Release> scene_;
};

std::optional<Result> fewest_rays(Peer const& peer, bool packets, double target,
                                  std::vector<double> const& exact, int& rays) {
  for (; rays <= max_rays; rays *= 2) {
    Result const result = peer.traced(rays, packets);
    if (percentile_99(result.fractions, exact) <= target) return result;
  }
  return std::nullopt;
}

void print_rows(char const* kind, int count, Scene const& scene, double least_target) {
  RendererOptions options;
  options.device = on_cpu;
  options.resolution = 16384;
  options.samples_only = true;
  std::vector<double> const exact = rendered(scene, options).fractions;
  Peer const peer(scene);
  int rays = 64;
  for (double const target : {1e-2, 1e-3, 1e-4}) {
    if (target < least_target) break;
    RendererOptions asked;
    asked.device = on_cpu;
    asked.error = target;
    Result const ours = rendered(scene, asked);
    std::printf("%-8s %8d %7.0e %9.4f %9.1e", kind, count, target, ours.milliseconds,
                percentile_99(ours.fractions, exact));
    auto const packets = fewest_rays(peer, true, target, exact, rays);
    if (packets) {
      Result const single = peer.traced(rays, false);
      double const faster = std::min(single.milliseconds, packets->milliseconds);
      std::printf(" %8d %9.4f %9.4f %7.2f\n", rays, single.milliseconds, packets->milliseconds,
                  ours.milliseconds / faster);
    } else {
      std::printf(" %8s %9s %9s %7s\n", "-", "-", "-", "-");
    }
    std::fflush(stdout);
  }
}

// `kind`: of scenes; all if empty.
void print_table(int most, double least_target, std::string_view kind) {
  limit_threads(1);
  std::printf("CPU, Embree %s\n", RTC_VERSION_STRING);
  std::printf(
      "scene      number  target      ours p99 error     rays    single   packets  ours / \n");
  auto const print = [&](char const* of, int count, auto const& scene_of) {
    if (kind.empty() || kind == of) print_rows(of, count, scene_of(count), least_target);
  };
  for (int const count : {20, 200, 1000, 8000, 32000, 200000, 1000000}) {
    if (count > most) continue;
    print("leaves", count, leaves);
    if (count > 32000) continue;
    print("louvres", count, [](int louvres) { return fine_louvres(louvres, 0.5); });
    print("pieces", count, pieces_of_louvres);
  }
  print("city", 600, city);
}

}  // namespace
}  // namespace gpu_shading

// embree_peer [MOST CASTERS [LEAST TARGET [KIND]]]
int main(int count, char** arguments) {
  int const most = count > 1 ? std::atoi(arguments[1]) : 1000000;
  double const least_target = count > 2 ? std::atof(arguments[2]) : 1e-4;
  char const* const kind = count > 3 ? arguments[3] : "";
  return gpu_shading::print_or_say_why("embree_peer",
                                       [&] { gpu_shading::print_table(most, least_target, kind); });
}
