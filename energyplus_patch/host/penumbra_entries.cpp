#include "host/penumbra_entries.h"

#include <memory>
#include <string>
#include <unordered_map>
#include <vector>

#include "gpu_shading/error.h"
#include "host/mirrored_surfaces.h"
#include "host/run.h"

// Functions that stand in for the member functions of Penumbra::Penumbra and Penumbra::Surface:
// same arguments in the same registers (`this` first), same objects by size. What they do is ours.

namespace gpu_shading::energyplus {
namespace {

using Coordinates = std::vector<float>;  // x, y, z of every vertex in turn

Ring to_ring(Coordinates const& xyz) {
  Ring ring;
  ring.reserve(xyz.size() / 3);
  for (std::size_t i = 0; i + 2 < xyz.size(); i += 3) {
    ring.emplace_back(xyz[i], xyz[i + 1], xyz[i + 2]);
  }
  return ring;
}

// EnergyPlus keeps 16 bytes for a surface and one pointer for the calculation.
struct SurfaceObject {
  std::shared_ptr<Surface> surface;
};
static_assert(sizeof(SurfaceObject) == 16);

struct PenumbraObject {
  std::unique_ptr<Session> session;
};
static_assert(sizeof(PenumbraObject) == 8);

void surface_construct(SurfaceObject* self, Coordinates const& outline, std::string const& name) {
  guarded([&] {
    new (self) SurfaceObject{std::make_shared<Surface>(Surface{name, {to_ring(outline), {}}})};
  });
}

void surface_construct_default(SurfaceObject* self) {
  guarded([&] { new (self) SurfaceObject{std::make_shared<Surface>()}; });
}

void surface_copy(SurfaceObject* self, SurfaceObject const& other) {
  new (self) SurfaceObject(other);
}

void surface_destroy(SurfaceObject* self) { self->~SurfaceObject(); }

void surface_add_hole(SurfaceObject* self, Coordinates const& hole) {
  guarded([&] { self->surface->polygon.holes.push_back(to_ring(hole)); });
}

// A device is opened once the surfaces are known, and its absence is then a fatal error; EnergyPlus
// must not fall back to another method by itself.
bool is_valid_context() { return true; }

void construct(PenumbraObject* self, unsigned /*size*/, void const* /*logger*/) {
  guarded([&] {
    auto& run = this_run();
    if (!run.model) throw Error("EnergyPlus starts shading before its input was read");
    new (self) PenumbraObject{std::make_unique<Session>(*run.model)};
    run.session = self->session.get();
  });
}

void destroy(PenumbraObject* self) {
  if (this_run().session == self->session.get()) this_run().session = nullptr;
  self->~PenumbraObject();
}

unsigned add_surface(PenumbraObject* self, SurfaceObject const& surface) {
  return guarded([&] { return self->session->add(*surface.surface); });
}

unsigned get_number_of_surfaces(PenumbraObject* self) {
  return static_cast<unsigned>(self->session->size());
}

// Needed only where what shading surfaces reflect counts.
void add_mirrored_surfaces(Session& session, Session::Messages const& messages) {
  auto const& ids = installation().surface_ids;
  if (!session.input().reflections || session.shading_surfaces().empty()) return;
  if (!ids || !hand_over_mirrored_surfaces(*this_run().state, session, *ids)) {
    messages.warning(
        "this EnergyPlus does not let mirrored shading surfaces be handed over: solar radiation "
        "that "
        "the back of a shading surface reflects is lost");
  }
}

void set_model(PenumbraObject* self) {
  guarded([&] {
    auto const messages = messages_of(this_run());
    add_mirrored_surfaces(*self->session, messages);
    State& state = *this_run().state;
    self->session->start(messages, installation().schedules.of(state),
                         [&state] { return installation().functions.latitude(state); });
  });
}

void set_sun_position(PenumbraObject* self, float azimuth, float altitude) {
  self->session->set_sun({azimuth, altitude});
}

// Rendering waits for the first question, when it is known what is wanted.
void submit_pssa(PenumbraObject* /*self*/) {}

float retrieve_pssa(PenumbraObject* self, unsigned id) {
  return guarded([&] { return self->session->projected_sunlit_area(id); });
}

std::unordered_map<unsigned, float> calculate_interior_pssas(
    PenumbraObject* self, std::vector<unsigned> const& windows,
    std::vector<unsigned> const& interiors) {
  return guarded([&] {
    std::unordered_map<unsigned, float> areas;
    if (windows.size() != 1) throw Error("EnergyPlus asks for interior areas of several windows");
    auto const answers = self->session->interior_areas(windows.front(), interiors);
    for (std::size_t i = 0; i < interiors.size(); ++i) areas[interiors[i]] += answers[i];
    return areas;
  });
}

template <typename Function>
void* address(Function* function) {
  return reinterpret_cast<void*>(function);
}

}  // namespace

std::vector<Entry> penumbra_entries() {
  return {
      {"_ZN8Penumbra7SurfaceC1ERKSt6vectorIfSaIfEERKNSt7__cxx1112basic_stringIcSt11char_"
       "traitsIcESaIcEEE",
       address(&surface_construct)},
      {"_ZN8Penumbra7SurfaceC1Ev", address(&surface_construct_default)},
      {"_ZN8Penumbra7SurfaceC1ERKS0_", address(&surface_copy)},
      {"_ZN8Penumbra7SurfaceD1Ev", address(&surface_destroy)},
      {"_ZN8Penumbra7Surface8add_holeERKSt6vectorIfSaIfEE", address(&surface_add_hole)},
      {"_ZN8Penumbra8Penumbra16is_valid_contextEv", address(&is_valid_context)},
      {"_ZN8Penumbra8PenumbraC1EjRKSt10shared_ptrIN8Courierr8CourierrEE", address(&construct)},
      {"_ZN8Penumbra8PenumbraD1Ev", address(&destroy)},
      {"_ZN8Penumbra8Penumbra11add_surfaceERKNS_7SurfaceE", address(&add_surface)},
      {"_ZN8Penumbra8Penumbra22get_number_of_surfacesEv", address(&get_number_of_surfaces)},
      {"_ZN8Penumbra8Penumbra9set_modelEv", address(&set_model)},
      {"_ZN8Penumbra8Penumbra16set_sun_positionEff", address(&set_sun_position)},
      {"_ZN8Penumbra8Penumbra11submit_pssaEv", address(&submit_pssa)},
      {"_ZN8Penumbra8Penumbra13retrieve_pssaEj", address(&retrieve_pssa)},
      {"_ZN8Penumbra8Penumbra24calculate_interior_pssasERKSt6vectorIjSaIjEES5_",
       address(&calculate_interior_pssas)},
  };
}

}  // namespace gpu_shading::energyplus
