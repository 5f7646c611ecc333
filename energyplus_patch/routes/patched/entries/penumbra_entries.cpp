#include "routes/patched/entries/penumbra_entries.h"

#include <memory>
#include <string>
#include <unordered_map>
#include <vector>

#include "gpu_shading/error.h"
#include "routes/patched/entries/run.h"
#include "routes/patched/memory/mirrored_surfaces.h"
#include "tasks/perform_task.h"

// Functions that replace the member functions of Penumbra::Penumbra and Penumbra::Surface: same
// arguments in the same registers (`this` first), and objects of the same size.

namespace gpu_shading::energyplus {
namespace {

using Coordinates = std::vector<float>;  // x, y, z of every vertex, one vertex after another

Ring to_ring(Coordinates const& xyz) {
  Ring ring;
  ring.reserve(xyz.size() / 3);
  for (std::size_t i = 0; i + 2 < xyz.size(); i += 3) {
    ring.emplace_back(xyz[i], xyz[i + 1], xyz[i + 2]);
  }
  return ring;
}

// EnergyPlus reserves 16 bytes for a surface and one pointer for the calculation.
struct SurfaceObject {
  std::shared_ptr<Surface> surface;
};
static_assert(sizeof(SurfaceObject) == 16);

struct PenumbraObject {
  std::unique_ptr<Session> session;
};
static_assert(sizeof(PenumbraObject) == 8);

void surface_construct(SurfaceObject* self, Coordinates const& outline, std::string const& name) {
  new (self) SurfaceObject{std::make_shared<Surface>(Surface{name, {to_ring(outline), {}}})};
}

void surface_construct_default(SurfaceObject* self) {
  new (self) SurfaceObject{std::make_shared<Surface>()};
}

void surface_copy(SurfaceObject* self, SurfaceObject const& other) {
  new (self) SurfaceObject(other);
}

void surface_destroy(SurfaceObject* self) { self->~SurfaceObject(); }

void surface_add_hole(SurfaceObject* self, Coordinates const& hole) {
  self->surface->polygon.holes.push_back(to_ring(hole));
}

// The device is opened once the surfaces are known. If there is none, that is a fatal error,
// because EnergyPlus must not fall back to another method by itself.
bool is_valid_context() { return true; }

void construct(PenumbraObject* self, unsigned /*size*/, void const* /*logger*/) {
  auto& run = this_run();
  if (!run.model) throw Error("EnergyPlus starts shading before its input was read");
  new (self) PenumbraObject{std::make_unique<Session>(*run.model)};
  run.session = self->session.get();
}

void destroy(PenumbraObject* self) {
  if (this_run().session == self->session.get()) this_run().session = nullptr;
  self->~PenumbraObject();
}

unsigned add_surface(PenumbraObject* self, SurfaceObject const& surface) {
  return self->session->add(*surface.surface);
}

unsigned get_number_of_surfaces(PenumbraObject* self) {
  return static_cast<unsigned>(self->session->size());
}

// Needed if light reflected by shading surfaces is modelled, or if an output shows the copies.
void add_mirrored_surfaces(Session& session, Messages const& messages) {
  auto const& ids = installation().surface_ids;
  if (!session.wants_mirrored() || session.shading_surfaces().empty()) return;
  if (!ids || !hand_over_mirrored_surfaces(*this_run().state, session, *ids)) {
    messages.warning(
        "this EnergyPlus does not let mirrored shading surfaces be handed over: their sunlit "
        "fraction is reported as 0, and solar radiation that the back of a shading surface "
        "reflects is lost");
  }
}

void set_model(PenumbraObject* self) {
  auto& session = *self->session;
  auto& installed = installation();
  State& state = *this_run().state;
  auto const messages = messages_of(this_run());
  add_mirrored_surfaces(session, messages);
  begin(session,
        {messages, installed.schedules.of(state),
         [&installed, &state] { return installed.functions.latitude(state); }},
        installed.task ? &*installed.task : nullptr);
}

void set_sun_position(PenumbraObject* self, float azimuth, float altitude) {
  self->session->set_sun({azimuth, altitude});
}

// Rendering waits for the first question, when the wanted receivers are known.
void submit_pssa(PenumbraObject* /*self*/) {}

float retrieve_pssa(PenumbraObject* self, unsigned id) {
  return static_cast<float>(self->session->projected_sunlit_area(id));
}

std::unordered_map<unsigned, float> calculate_interior_pssas(
    PenumbraObject* self, std::vector<unsigned> const& windows,
    std::vector<unsigned> const& interiors) {
  std::unordered_map<unsigned, float> areas;
  if (windows.size() != 1) throw Error("EnergyPlus asks for interior areas of several windows");
  auto const answers = self->session->interior_areas(windows.front(), interiors);
  for (std::size_t i = 0; i < interiors.size(); ++i) {
    areas[interiors[i]] += static_cast<float>(answers[i]);
  }
  return areas;
}

template <auto function>
EntryPatch guarded_entry(char const* symbol) {
  return replace(symbol, &Guarded<function>::call);
}

}  // namespace

std::vector<EntryPatch> penumbra_entries() {
  return {
      guarded_entry<&surface_construct>(
          "_ZN8Penumbra7SurfaceC1ERKSt6vectorIfSaIfEERKNSt7__cxx1112basic_stringIcSt11char_"
          "traitsIcESaIcEEE"),
      guarded_entry<&surface_construct_default>("_ZN8Penumbra7SurfaceC1Ev"),
      guarded_entry<&surface_copy>("_ZN8Penumbra7SurfaceC1ERKS0_"),
      guarded_entry<&surface_destroy>("_ZN8Penumbra7SurfaceD1Ev"),
      guarded_entry<&surface_add_hole>("_ZN8Penumbra7Surface8add_holeERKSt6vectorIfSaIfEE"),
      guarded_entry<&is_valid_context>("_ZN8Penumbra8Penumbra16is_valid_contextEv"),
      guarded_entry<&construct>("_ZN8Penumbra8PenumbraC1EjRKSt10shared_ptrIN8Courierr8CourierrEE"),
      guarded_entry<&destroy>("_ZN8Penumbra8PenumbraD1Ev"),
      guarded_entry<&add_surface>("_ZN8Penumbra8Penumbra11add_surfaceERKNS_7SurfaceE"),
      guarded_entry<&get_number_of_surfaces>("_ZN8Penumbra8Penumbra22get_number_of_surfacesEv"),
      guarded_entry<&set_model>("_ZN8Penumbra8Penumbra9set_modelEv"),
      guarded_entry<&set_sun_position>("_ZN8Penumbra8Penumbra16set_sun_positionEff"),
      guarded_entry<&submit_pssa>("_ZN8Penumbra8Penumbra11submit_pssaEv"),
      guarded_entry<&retrieve_pssa>("_ZN8Penumbra8Penumbra13retrieve_pssaEj"),
      guarded_entry<&calculate_interior_pssas>(
          "_ZN8Penumbra8Penumbra24calculate_interior_pssasERKSt6vectorIjSaIjEES5_"),
  };
}

}  // namespace gpu_shading::energyplus
