#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <bitset>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <map>
#include <new>
#include <optional>
#include <set>
#include <utility>
#include <vector>

namespace gpu_shading::energyplus {

// The bits of a number that is part of a question.
inline std::uint64_t bits_of(double value) { return std::bit_cast<std::uint64_t>(value); }

// Answers to questions that recur in much the same order, such as those of a loop that is run
// again: an answer is looked for where the last one was found. Questions are compared bit by bit.
// Answers that are no longer wanted in between are passed over, up to a few dozen.
template <std::size_t Words>
class SequenceCache {
 public:
  using Question = std::array<std::uint64_t, Words>;

  // `room`: for how many more answers there is room, here and in others that share it. It must
  // outlive this. Answers without room are not kept.
  explicit SequenceCache(std::size_t& room) : room_(room) {}
  SequenceCache(SequenceCache const&) = delete;
  SequenceCache& operator=(SequenceCache const&) = delete;
  ~SequenceCache() { forget(); }

  // The first question is expected next. Forgets all answers if most of them were of no use.
  void restart() {
    if (missed_ > found_) forget();
    next_ = missed_ = found_ = 0;
  }

  // The answer, until keep() or clear(); nullptr if it is not known.
  double const* find(Question const& question) {
    constexpr std::size_t ahead = 64;
    auto const end = std::min(kept_.size(), next_ + ahead);
    for (std::size_t i = next_; i < end; ++i) {
      if (!same(kept_[i].question, question)) continue;
      next_ = i + 1;
      ++found_;
      return &kept_[i].answer;
    }
    if (next_ < kept_.size()) ++missed_;
    return nullptr;
  }

  // Keeps the answer to the question that was not found, if it came after all that are known and
  // there is memory for it: this is called from within EnergyPlus.
  void keep(Question const& question, double answer) noexcept {
    if (next_ != kept_.size() || room_ == 0) return;
    try {
      kept_.push_back({question, answer});
    } catch (std::bad_alloc const&) {
      return;
    }
    --room_;
    next_ = kept_.size();
  }

  void clear() {
    forget();
    restart();
  }

 private:
  // From behind, where questions that follow each other differ; without a call of memcmp().
  static bool same(Question const& a, Question const& b) {
    for (std::size_t i = Words; i-- > 0;) {
      if (a[i] != b[i]) return false;
    }
    return true;
  }

  void forget() {
    room_ += kept_.size();
    kept_.clear();
  }

  struct Kept {
    Question question;
    double answer;
  };
  std::vector<Kept> kept_;
  std::size_t& room_;
  std::size_t next_ = 0;
  std::size_t found_ = 0;
  std::size_t missed_ = 0;
};

// Recurring work of EnergyPlus's daylight factors for its reference points and maps, and work that
// need not be done at all. It computes them for whole days, or, with shadows
// renewed at every timestep, for one timestep of an hour.
class DaylightMemory {
 public:
  // A Daylighting:Controls with its reference points or a map, by EnergyPlus's number.
  enum class Kind { control, map };
  using Points = std::pair<Kind, int>;

  // What EnergyPlus says, in its order. Shadows of the beam are computed at a timestep of an hour,
  // 1 .. 24;
  void note_shadows(int hour);
  // then factors, of all points. `rays_hold`: an answer to a ray does, as long as the run;
  void begin(bool rays_hold);
  // the sun is up in an hour of those;
  void note_sun() { sun_ = true; }
  // then those of points, whether the sun is up in EnergyPlus's weather. False if they are known to
  // be what they are already: zero.
  bool begin_points(Points points, bool sun_in_weather);
  void end_points() { rays_ = nullptr; }

  // Answers to the rays of these points; nullptr: they are not kept.
  using Rays = SequenceCache<7>;
  Rays* rays() { return rays_; }
  enum class Ray { through_window, in_room };
  static Rays::Question question(Ray kind, int window, glm::dvec3 const& from,
                                 glm::dvec3 const& to);

  // The light that enters by a window and that the surfaces of an enclosure reflect, at an hour.
  struct Reflected {
    int hour = 0;
    bool first = false;  // it also notes what obstructs the sky of the window
    int enclosure = 0;
    int window = 0;

    bool operator==(Reflected const&) const = default;
  };
  // EnergyPlus computes it for each point anew, and keeps it by hour for the window that it was
  // computed for last, and the obstructions for one window. False if it is as EnergyPlus keeps it.
  bool begin_reflected(Reflected const& reflected);
  // It also adds to sums, so that it must not be left out.
  void note_sums();

  // While EnergyPlus integrates over the sky that a window sees, always in the same directions, the
  // luminance in each of them is kept until factors are computed again. Whether that is of use: it
  // has integrated more than once over the sky of that window at an hour.
  bool sky_recurs(int hour, int window);
  class SkyOfWindow {
   public:
    SkyOfWindow(DaylightMemory& memory, int hour, int window);
    SkyOfWindow(SkyOfWindow const&) = delete;
    SkyOfWindow& operator=(SkyOfWindow const&) = delete;
    ~SkyOfWindow() { memory_.luminances_ = before_; }

   private:
    DaylightMemory& memory_;
    SequenceCache<3>* before_;
  };

  // The luminance of one of EnergyPlus's skies in a direction, which `compute` returns, too.
  template <typename Compute>
  double luminance(int sky, double azimuth, double altitude, Compute const& compute) {
    if (luminances_ == nullptr) return compute();
    Luminances::Question const question{static_cast<std::uint64_t>(sky), bits_of(azimuth),
                                        bits_of(altitude)};
    auto const* known = luminances_->find(question);
    if (known != nullptr && !std::exchange(untested_, false)) return *known;
    double const value = compute();
    bool const other_sun = known != nullptr && bits_of(*known) != bits_of(value);
    if (other_sun) luminances_->clear();
    if (other_sun || known == nullptr) luminances_->keep(question, value);
    return value;
  }

 private:
  using Luminances = SequenceCache<3>;
  static constexpr std::size_t hours = 24;
  struct Zeros {
    bool now = false;                // all that does not belong to an hour
    std::bitset<hours + 1> of_hour;  // the factors of an hour
  };

  bool is_dark(bool sun_in_weather) const { return hour_ && !sun_ && !sun_in_weather; }

  std::size_t shadows_ = 0;  // timesteps since factors were computed
  int last_hour_ = 0;
  std::optional<int> hour_;  // of the only timestep for which factors are computed
  bool sun_ = false;
  std::map<Points, Zeros> zeros_;
  std::size_t room_for_rays_ = 1'000'000;        // 64 MB
  std::size_t room_for_luminances_ = 1'000'000;  // 32 MB
  bool rays_hold_ = false;
  struct KeptReflected {
    Reflected reflected;
    Reflected obstructions;  // where they are from
  };
  std::array<std::optional<KeptReflected>, hours + 1> reflected_;
  std::optional<KeptReflected>* reflected_now_ = nullptr;
  Reflected obstructions_;
  std::map<Points, Rays> rays_of_;
  Rays* rays_ = nullptr;
  std::set<std::pair<int, int>> skies_;  // hours and windows that were asked about
  std::set<int> recurring_skies_;        // windows
  std::map<std::pair<int, int>, Luminances> luminances_of_;  // by hour and window
  Luminances* luminances_ = nullptr;
  bool untested_ = false;
};

}  // namespace gpu_shading::energyplus
