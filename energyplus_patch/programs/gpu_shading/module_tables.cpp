#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <ostream>
#include <utility>

#include "gpu_shading/error.h"
#include "platform/text.h"
#include "programs/gpu_shading/map_files.h"
#include "programs/gpu_shading/module_files.h"
#include "reports/report.h"
#include "runs/run_times.h"

namespace gpu_shading::energyplus {
namespace {

constexpr float whole = 65535.0F;

// One time of an array.
void read_row(std::istream& in, std::vector<float>& fractions) {
  std::vector<unsigned char> bytes(2 * fractions.size());
  in.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  constexpr unsigned byte = 256;
  for (std::size_t i = 0; i < fractions.size(); ++i) {
    fractions[i] = static_cast<float>(bytes[2 * i] + byte * bytes[2 * i + 1]) / whole;
  }
}

class Summing {
 public:
  explicit Summing(ModuleLayout const& layout) : layout_(layout) {
    auto const& spec = layout.spec();
    for (std::size_t k = 0; k < spec.cells(); ++k) diodes_.push_back(layout.diode(k));
  }

  std::vector<StringLight> strings(std::vector<float> const& fractions) const {
    std::vector<StringLight> strings(static_cast<std::size_t>(layout_.strings()), {0.0F, 1.0F, 0});
    std::vector<double> sums(strings.size());
    std::vector<std::size_t> counts(strings.size());
    auto const cells = diodes_.size();
    std::vector<bool> shaded(static_cast<std::size_t>(layout_.spec().diodes));
    for (std::size_t m = 0; m < layout_.modules().size(); ++m) {
      auto const s = static_cast<std::size_t>(layout_.modules()[m].string);
      std::fill(shaded.begin(), shaded.end(), false);
      for (std::size_t k = 0; k < cells; ++k) {
        float const lit = fractions[m * cells + k];
        sums[s] += lit;
        strings[s].least = std::min(strings[s].least, lit);
        // Less is rounding, or the error of pixels.
        constexpr float clear = 0.999F;
        if (lit < clear) shaded[static_cast<std::size_t>(diodes_[k])] = true;
      }
      counts[s] += cells;
      strings[s].blocks += static_cast<std::uint32_t>(std::ranges::count(shaded, true));
    }
    for (std::size_t s = 0; s < strings.size(); ++s) {
      strings[s].sunlit = static_cast<float>(sums[s] / static_cast<double>(counts[s]));
    }
    return strings;
  }

 private:
  ModuleLayout const& layout_;
  std::vector<int> diodes_;
};

std::string time_fields(RunTime const& time) {
  return fmt::format("{},{},{},{}", time.month, time.day, time.hour, time.timestep);
}

}  // namespace

double FieldLight::beam(std::size_t module) const {
  auto const count = layout.spec().cells();
  double sum = 0.0;
  for (std::size_t k = 0; k < count; ++k) sum += cells[module * count + k];
  return sum / static_cast<double>(count);
}

FieldLight read_light(ModuleField field, PvModules const& spec, RunTimes const& run,
                      std::filesystem::path const& array) {
  ModuleLayout layout(spec, field.surface, field.polygon);
  FieldLight light{std::move(field), std::move(layout), "", 0.0, {}, {}, {}};
  light.cells.resize(light.layout.modules().size() * spec.cells());
  Summing const summing(light.layout);
  std::ifstream in(array, std::ios::binary);
  std::vector<float> fractions(light.cells.size());
  for (auto const& time : run.times) {
    read_row(in, fractions);
    double const cosine = glm::dot(to_vector(time.sun), light.layout.axes().normal);
    bool const faced = cosine >= min_cosine;
    light.cosines.push_back(faced ? cosine : 0.0);
    constexpr double watts_in_kilowatt = 1000.0;
    double const energy = light.cosines.back() * time.beam / run.steps_per_hour / watts_in_kilowatt;
    light.unshaded += energy;
    for (std::size_t i = 0; i < fractions.size(); ++i) light.cells[i] += energy * fractions[i];
    for (auto const& string : summing.strings(fractions)) light.strings.push_back(string);
  }
  if (!in) throw Error(fmt::format("{}: cannot be read", array.string()));
  return light;
}

void write_cells(FieldLight const& light, std::size_t times, std::filesystem::path const& array,
                 std::ostream& npy) {
  auto const& spec = light.layout.spec();
  write_npy_header("<u2",
                   {times, light.layout.modules().size(), static_cast<std::size_t>(spec.cell_rows),
                    static_cast<std::size_t>(spec.cell_columns)},
                   npy);
  npy << std::ifstream(array, std::ios::binary).rdbuf();
}

void write_modules(std::vector<FieldLight> const& fields, std::ostream& csv) {
  csv << "object,surface,files,string,column,row,x [m],y [m],z [m],azimuth [deg],tilt [deg],"
         "area [m2],sky view factor,unshaded view factor,unshaded beam [kWh/m2],beam [kWh/m2],"
         "beam loss\n";
  for (auto const& light : fields) {
    auto const& axes = light.layout.axes();
    auto const [azimuth, tilt] = facing_of(axes.normal);
    for (std::size_t m = 0; m < light.layout.modules().size(); ++m) {
      auto const& module = light.layout.modules()[m];
      auto const place = axes.place((module.box.low + module.box.high) / 2.0);
      double const beam = light.beam(m);
      csv << fmt::format(
          "{},{},{},{},{},{},{:.4f},{:.4f},{:.4f},{:.2f},{:.2f},{:.6g},{:.4f},{:.4f},{:.6g},{:.6g},"
          "{:.6f}\n",
          csv_field(light.field.object), csv_field(light.field.surface), csv_field(light.stem),
          module.string + 1, module.column + 1, module.row + 1, place.x, place.y, place.z, azimuth,
          tilt, light.layout.spec().width * light.layout.spec().length, light.field.sky[m].view,
          light.field.sky[m].unshaded, light.unshaded, beam,
          light.unshaded > 0.0 ? 1.0 - beam / light.unshaded : 0.0);
    }
  }
}

void write_times(RunTimes const& run, std::ostream& csv) {
  csv << "month,day,hour,timestep,sun azimuth [deg],sun altitude [deg],beam [W/m2],diffuse [W/m2],"
         "air [C],wind [m/s]\n";
  for (auto const& time : run.times) {
    csv << fmt::format("{},{:.6f},{:.6f},{:.6g},{:.6g},{:.4g},{:.4g}\n", time_fields(time),
                       degrees_clockwise(time.sun.azimuth), glm::degrees(time.sun.altitude),
                       time.beam, time.diffuse, time.temperature, time.wind);
  }
}

void write_strings(std::vector<FieldLight> const& fields, RunTimes const& run, std::ostream& csv) {
  csv << "surface,string,month,day,hour,timestep,beam on the plane [W/m2],sunlit fraction,"
         "least of a cell,shaded blocks,blocks\n";
  for (auto const& light : fields) {
    auto const strings = static_cast<std::size_t>(light.layout.strings());
    std::vector<std::uint32_t> blocks(strings);
    for (auto const& module : light.layout.modules()) {
      blocks[static_cast<std::size_t>(module.string)] +=
          static_cast<std::uint32_t>(light.layout.spec().diodes);
    }
    auto const name = csv_field(light.field.surface);
    for (std::size_t s = 0; s < strings; ++s) {
      for (std::size_t i = 0; i < run.times.size(); ++i) {
        if (light.cosines[i] <= 0.0) continue;
        auto const& string = light.strings[i * strings + s];
        csv << fmt::format("{},{},{},{:.6g},{:.5f},{:.5f},{},{}\n", name, s + 1,
                           time_fields(run.times[i]), light.cosines[i] * run.times[i].beam,
                           string.sunlit, string.least, string.blocks, blocks[s]);
      }
    }
  }
}

}  // namespace gpu_shading::energyplus
