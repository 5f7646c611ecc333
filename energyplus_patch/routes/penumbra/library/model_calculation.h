#pragma once

#include <map>
#include <string>

#include "calculation/session.h"
#include "gpu_shading_answers.h"

namespace gpu_shading::energyplus {

// Of a model that was read: with its transmittances, screens, schedules and rules, and with
// surroundings and shading surfaces that EnergyPlus does not see.
class ModelCalculation : public answers::Calculation {
 public:
  ModelCalculation(Model model, answers::Log log);

  unsigned add(answers::PlainSurface surface) override;
  int add_mirrored(unsigned original) override;
  void start(answers::Simulation simulation) override;
  void set_time(int hour, int timestep) override;
  void set_sun(double azimuth, double altitude) override;
  float sunlit_area(unsigned surface) override;
  std::vector<float> sunlit_areas(std::vector<unsigned> const& surfaces) override;
  std::vector<float> interior_areas(unsigned window,
                                    std::vector<unsigned> const& interiors) override;
  double ray_transmittance(answers::DaylightRay const& ray) override;
  void begin_daylighting() override;
  std::string vendor() override;
  void finish() override;

 private:
  Messages messages() const;
  Schedules schedules() const;
  int schedule_number(std::string const& name) const;

  answers::Log log_;
  answers::Simulation simulation_;
  mutable std::map<std::string, int> schedule_numbers_;
  bool rays_answered_ = false;
  bool started_ = false;
  Session session_;
};

}  // namespace gpu_shading::energyplus
