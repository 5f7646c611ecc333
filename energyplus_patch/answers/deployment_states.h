#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

namespace gpu_shading::energyplus {

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

}  // namespace gpu_shading::energyplus
