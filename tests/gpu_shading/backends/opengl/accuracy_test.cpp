// Pixel counting against exact polygon clipping, over random scenes.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/vec3.hpp>
#include <numeric>
#include <random>
#include <utility>
#include <vector>

#include "gpu_shading/renderer.h"
#include "support/exact.h"
#include "support/pixel_count.h"
#include "support/random_scene.h"
#include "support/regular_shades.h"
#include "support/shapes.h"

namespace gpu_shading {
namespace {

constexpr std::uint32_t scenes = 200;

struct Errors {
  double mean = 0.0;
  double most = 0.0;
  double signed_mean = 0.0;
};

void add(Errors& errors, double error) {
  errors.mean += std::abs(error) / scenes;
  errors.signed_mean += error / scenes;
  errors.most = std::max(errors.most, std::abs(error));
}

struct Forms {
  Errors ratio;  // exact projected area x lit share of the receiver's own pixels
  Errors plain;  // N x Ap, as Jones et al. have it
};

// Errors of the projected sunlit surface fraction, As/At cos(theta).
Forms errors_at(int resolution, DeviceChoice how) {
  Forms forms;
  for (std::uint32_t seed = 1; seed <= scenes; ++seed) {
    RandomScene const random = random_scene(seed);
    RendererOptions options;
    options.resolution = resolution;
    options.samples_only = true;
    options.device = how;
    SurfaceId const receiver = 0;
    auto const [answered, counted] = PixelCount(random.scene, options).areas(random.sun, receiver);
    double const exact_area = exact::projected_sunlit_area(random.scene, random.sun, receiver);
    double const whole = area(random.scene[receiver].polygon);
    add(forms.ratio, (answered - exact_area) / whole);
    add(forms.plain, (counted - exact_area) / whole);
  }
  for (auto const& [name, errors] :
       {std::pair("lit share", forms.ratio), std::pair("N x Ap", forms.plain)}) {
    std::printf("%4d pixels %s, %-9s: PSSF error mean %.2e, signed mean %+.2e, most %.2e\n",
                resolution, how == by_opengl ? "drawn" : "counted", name, errors.mean,
                errors.signed_mean, errors.most);
  }
  return forms;
}

// Least squares through (log resolution, log error).
double slope(std::vector<int> const& resolutions, std::vector<double> const& errors) {
  double sx = 0.0;
  double sy = 0.0;
  double sxx = 0.0;
  double sxy = 0.0;
  auto const n = static_cast<double>(errors.size());
  for (std::size_t i = 0; i < errors.size(); ++i) {
    double const x = std::log(resolutions[i]);
    double const y = std::log(errors[i]);
    sx += x;
    sy += y;
    sxx += x * x;
    sxy += x * y;
  }
  return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

TEST(Accuracy, MostScenesAreShaded) {
  int shaded = 0;
  for (std::uint32_t seed = 1; seed <= scenes; ++seed) {
    RandomScene const random = random_scene(seed);
    double const whole = exact::projected_area(random.scene, random.sun, 0);
    double const lit = exact::projected_sunlit_area(random.scene, random.sun, 0);
    EXPECT_GE(lit, 0.0);
    EXPECT_LE(lit, whole + 1e-6);  // polyclipping rounds to 10 nm
    if (lit < 0.95 * whole) ++shaded;
  }
  EXPECT_GT(shaded, 150);
}

TEST(Accuracy, PssfOfRandomScenesAt512PixelsIsWithinHalfAPerMil) {
  for (DeviceChoice const how : {by_opengl, on_cpu}) {
    Forms const forms = errors_at(512, how);
    Errors const& errors = forms.ratio;
    EXPECT_LT(errors.mean, 5e-4);
    EXPECT_LT(errors.most, 5e-3);
    // Rounding up and down equally often.
    EXPECT_LT(std::abs(errors.signed_mean), 1e-4);
    // Why the answer is the share and not the count.
    EXPECT_LT(errors.mean, forms.plain.mean);
  }
}

TEST(Accuracy, ErrorFallsWithResolution) {
  std::vector<int> const resolutions{256, 512, 1024, 2048};
  std::vector<double> means(resolutions.size());
  std::transform(resolutions.begin(), resolutions.end(), means.begin(),
                 [](int resolution) { return errors_at(resolution, on_cpu).ratio.mean; });
  double const falls = slope(resolutions, means);
  std::printf("mean error ~ resolution^%.2f\n", falls);
  // A pixel's error at the edges alone gives -1, errors that cancel along an edge -1.5.
  EXPECT_LT(falls, -0.7);
}

// A window behind louvres, turned about its long axis; or behind quadrilaterals of any shape.
Scene louvres(int count) {
  Scene scene;
  scene.add({"window", south_facing(0, 0, 0, 3, 2)});
  for (int i = 0; i < count; ++i) {
    double const height = 2.0 * (i + 0.5) / count;
    scene.add({"louvre", parallelogram({-0.2, -0.5 - 0.6 / count, height}, {3.4, 0, 0},
                                       {0, 0.6 / count, 0.01 / count})});
  }
  return scene;
}

Scene scattered(int count) {
  std::mt19937 generator(41);
  auto const between = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(generator()) / std::mt19937::max();
  };
  Scene scene;
  scene.add({"window", south_facing(0, 0, 0, 3, 2)});
  double const size = std::min(1.0, 3.0 / std::sqrt(count));
  auto const edge = [&] {
    return size * glm::dvec3(between(-0.5, 0.5), between(-0.5, 0.5), between(-0.5, 0.5));
  };
  for (int i = 0; i < count; ++i) {
    glm::dvec3 const corner(between(-0.5, 3.5), between(-1.8, -0.3), between(-0.5, 3.5));
    scene.add({"leaf", parallelogram(corner, edge(), edge())});
  }
  return scene;
}

// Tiles as the error asked for needs them: its promise, over scenes that its rule was not fitted
// to.
TEST(Accuracy, NinetyNineOfAHundredAreWithinTheErrorAskedFor) {
  for (double const error : {3e-3, 1e-3}) {
    std::vector<double> errors;
    auto const add_scene = [&](Scene const& scene, std::vector<SunDirection> const& suns) {
      RendererOptions options;
      options.error = error;
      options.samples_only = true;
      Renderer renderer(scene, options);
      for (SunDirection const sun : suns) {
        double const whole = exact::projected_area(scene, sun, 0);
        if (whole < 0.02 * area(scene[0].polygon)) continue;
        double const lit = exact::projected_sunlit_area(scene, sun, 0);
        errors.push_back(std::abs(sunlit(renderer, sun, 0).projected_area - lit) / whole);
      }
    };
    std::vector<SunDirection> suns;
    suns.reserve(30);
    for (int i = 0; i < 30; ++i) suns.push_back(sun_at(107 + 5 * i, 4 + i * 29 % 71));
    for (int const count : {2, 17, 61}) {
      add_scene(louvres(count), suns);
      add_scene(scattered(count), suns);
    }
    for (std::uint32_t seed = 1; seed <= scenes; seed += 2) {
      RandomScene const random = random_scene(seed);
      add_scene(random.scene, {random.sun});
    }
    auto const over =
        std::count_if(errors.begin(), errors.end(), [&](double value) { return value > error; });
    double const mean =
        std::accumulate(errors.begin(), errors.end(), 0.0) / static_cast<double>(errors.size());
    std::printf("error %g: mean %.2e, most %.2e, over it %td of %zu\n", error, mean,
                *std::max_element(errors.begin(), errors.end()), over, errors.size());
    EXPECT_GT(errors.size(), 200U);
    EXPECT_LE(static_cast<double>(over), 0.01 * static_cast<double>(errors.size()));
    // Nor much finer than that: pixels are time.
    EXPECT_GT(mean, 0.03 * error);
  }
}

// Which alias with the pixels of some tiles by up to 5e-3.
TEST(Accuracy, DrawnBehindManyFinsIsWithinTheTarget) {
  double most = 0.0;
  for (int const count : blade_counts(500, 2000, 1.5, true)) {
    RegularShades const shades{count, true};
    RendererOptions options;
    options.device = by_opengl;
    options.samples_only = true;
    Renderer renderer(shades.scene(), options);
    for (SunDirection const sun : spread_suns(2)) {
      double const cosine = -std::cos(sun.azimuth) * std::cos(sun.altitude);
      double const whole = shades.width() * shades.height() * cosine;
      double const got = sunlit(renderer, sun, 0).projected_area / whole;
      most = std::max(most, std::abs(got - shades.sunlit_fraction(sun)));
    }
  }
  EXPECT_LT(most, 1e-3);
}

}  // namespace
}  // namespace gpu_shading
