#pragma once

#include <boost/container/flat_map.hpp>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "gpu_shading/renderer.h"

namespace gpu_shading::energyplus {

// Position of a receiver in the order in which receivers were first asked for.
using ReceiverNumber = std::uint32_t;

// The deployed fractions of screens (Renderer::set_deployments) that a run has met, numbered, so
// that an answer can be stored for each.
class DeploymentStates {
 public:
  using Shares = std::vector<double>;

  std::uint32_t number_of(Shares const& shares) {
    auto const [place, added] =
        numbers_.try_emplace(shares, static_cast<std::uint32_t>(states_.size()));
    if (added) states_.push_back(shares);
    return place->second;
  }

  std::optional<std::uint32_t> find(Shares const& shares) const {
    auto const found = numbers_.find(shares);
    return found == numbers_.end() ? std::nullopt : std::optional(found->second);
  }

  std::size_t size() const { return states_.size(); }
  Shares const& operator[](std::uint32_t number) const { return states_.at(number); }

 private:
  std::map<Shares, std::uint32_t> numbers_;
  std::vector<Shares> states_;
};

// Limits of every answer about a scene, whatever file it comes from.
struct AnswerLimits {
  std::vector<double> areas;  // by surface, m2
  std::size_t schedules = 0;

  // Whether it is an answer about an area of at most so many m2.
  bool allow(Sunlit const& answer, double area) const;
};

// Sunlit::error as it is kept: not a number where it was not measured.
float kept_error(std::optional<double> error);
std::optional<double> error_of(float kept);

// Answers kept by direction and by the state of the screens' deployments: warm-up days, sizing
// periods and the sky's patches come back to the same ones. They hold whatever the transmittance
// schedules say, which are applied to them afterwards. Bounded by is_full().
class AnswerStore {
 public:
  static constexpr std::size_t default_max_bytes = std::size_t{512} << 20U;

  // Directions are many, and most have little in each map.
  template <typename Key, typename Value>
  using Map = boost::container::flat_map<Key, Value>;

  struct Direction {
    SunDirection sun;
    std::uint32_t state = 0;            // DeploymentStates
    std::vector<float> projected_area;  // by receiver; not a number, or too short, where unknown
    std::vector<float> errors;          // kept_error() by receiver; too short where it is 0
    // Parts that pass scheduled shades, of the receivers that have such in view.
    Map<ReceiverNumber, std::vector<ScheduledPart>> scheduled;
    // What the sun lights of a list of interior surfaces through a window: places in
    // `interior_area`, and in `interior_scheduled` of the parts that pass scheduled shades.
    struct Interior {
      std::uint32_t first = 0;
      std::uint32_t count = 0;
      float error = 0.0F;               // kept_error()
      std::optional<SurfaceId> window;  // once EnergyPlus has asked
    };
    Map<std::uint64_t, Interior> interior;  // by window and list
    std::vector<float> interior_area;
    Map<std::uint32_t, std::vector<ScheduledPart>> interior_scheduled;
    bool recalled = false;  // some of it is from earlier runs (DiskCache)
    bool asked = false;     // by EnergyPlus
    bool sampled = false;   // as a sample; a direction that is neither was rendered ahead

    bool knows(ReceiverNumber receiver) const {
      return receiver < projected_area.size() &&
             projected_area[receiver] == projected_area[receiver];
    }
    std::optional<double> error(ReceiverNumber receiver) const {
      return receiver < errors.size() ? error_of(errors[receiver]) : 0.0;
    }
    // A known answer.
    Sunlit sunlit(ReceiverNumber receiver) const;
    // The same with the schedules' values.
    double area(ReceiverNumber receiver, std::span<double const> factors) const;
    std::vector<Sunlit> sunlit(Interior const& answers) const;
    std::vector<float> areas(Interior const& answers, std::span<double const> factors) const;
  };

  explicit AnswerStore(std::size_t max_bytes = default_max_bytes) : max_bytes_(max_bytes) {
    // Most directions are new: the fewer others are met where one would be, the fewer are read.
    directions_.max_load_factor(0.25F);
  }

  // To be asked before answers are added, and then cleared: their memory may exceed the bound by
  // what is added until the next time.
  bool is_full() const { return bytes_ + sizeof(Direction) > max_bytes_; }
  void clear();

  // The entry of a direction and a state, made where there is none. Valid until clear().
  Direction& at(SunDirection sun, std::uint32_t state);

  // nullptr where there is none.
  Direction const* find(SunDirection sun, std::uint32_t state) const;

  void keep(Direction& direction, ReceiverNumber receiver, Sunlit answer);
  Direction::Interior& keep_interior(Direction& direction, std::uint64_t window_and_list,
                                     std::vector<Sunlit> answers);

  // Keeps what another direction knows of a receiver, whose number is another there.
  void copy(Direction const& from, ReceiverNumber known, Direction& direction,
            ReceiverNumber receiver);

  // Memory without the containers' own.
  std::size_t bytes() const { return bytes_; }
  std::size_t size() const { return directions_.size(); }

  template <typename Visit>
  void for_each(Visit const& visit) const {
    for (auto const& [key, direction] : directions_) visit(direction);
  }

 private:
  struct Key {
    SunDirection sun;
    std::uint32_t state;

    bool operator==(Key const&) const = default;
  };
  struct Hash {
    std::size_t operator()(Key const& key) const {
      std::hash<double> const hash;
      constexpr std::size_t odd = 0x9e3779b97f4a7c15;
      return (hash(key.sun.azimuth) * odd ^ hash(key.sun.altitude)) * odd ^ key.state;
    }
  };

  std::size_t max_bytes_;
  std::size_t bytes_ = 0;
  std::unordered_map<Key, Direction, Hash> directions_;
};

}  // namespace gpu_shading::energyplus
