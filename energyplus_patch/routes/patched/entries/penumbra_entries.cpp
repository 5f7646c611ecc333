#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "gpu_shading/error.h"
#include "routes/patched/entries/entries.h"
#include "routes/patched/entries/run.h"
#include "routes/patched/memory/surface_ids.h"
#include "tasks/perform_task.h"

// Functions that replace the member functions of Penumbra::Penumbra and Penumbra::Surface: same
// arguments in the same registers (`this` first), and objects of the same size.

namespace gpu_shading::energyplus {

// EnergyPlus reserves 16 bytes for a surface and one pointer for the calculation.
struct SurfaceObject {
  std::shared_ptr<Surface> surface;
};
static_assert(sizeof(SurfaceObject) == 16);

struct PenumbraObject {
  std::unique_ptr<Session> session;
};
static_assert(sizeof(PenumbraObject) == 8);

namespace {

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

void construct(PenumbraObject* self, unsigned /*size*/,
               std::shared_ptr<Courierr::Courierr> const& /*logger*/) {
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
  Simulation simulation{messages, installed.schedules.of(state),
                        [&installed, &state] { return installed.functions.latitude(state); }};
  simulation.takes_sky_multipliers = installed.serves(Need::sky_patches);
  if (installed.served.contains(Need::outputs)) {
    simulation.add_output = [&](std::string const& name, std::string_view unit,
                                std::string const& object, double& value) {
      installed.functions.add_output(state, name, unit, object, value);
    };
  }
  begin(session, std::move(simulation), installed.task ? &*installed.task : nullptr);
}

void set_sun_position(PenumbraObject* self, float azimuth, float altitude) {
  self->session->set_sun({azimuth, altitude});
  note_sun();
}

// Rendering waits for the first question, when the wanted receivers are known.
void submit_pssa(PenumbraObject* /*self*/) {}

float retrieve_pssa(PenumbraObject* self, unsigned id) {
  return static_cast<float>(self->session->projected_sunlit_area(id));
}

InteriorAreas calculate_interior_pssas(PenumbraObject* self, std::vector<unsigned> const& windows,
                                       std::vector<unsigned> const& interiors) {
  InteriorAreas areas;
  if (windows.size() != 1) throw Error("EnergyPlus asks for interior areas of several windows");
  auto const answers = self->session->interior_areas(windows.front(), interiors);
  areas.reserve(interiors.size());
  for (std::size_t i = 0; i < interiors.size(); ++i) {
    areas[interiors[i]] += static_cast<float>(answers[i]);
  }
  return areas;
}

template <auto function, typename Signature>
Entry guarded_entry(Function<Signature> const& symbol) {
  return replace(symbol, &Guarded<function>::call);
}

}  // namespace

std::vector<Entry> penumbra_entries() {
  return {
      guarded_entry<&surface_construct>(symbol::surface_construct),
      guarded_entry<&surface_construct_default>(symbol::surface_construct_default),
      guarded_entry<&surface_copy>(symbol::surface_copy),
      guarded_entry<&surface_destroy>(symbol::surface_destroy),
      guarded_entry<&surface_add_hole>(symbol::surface_add_hole),
      guarded_entry<&is_valid_context>(symbol::is_valid_context),
      guarded_entry<&construct>(symbol::penumbra_construct),
      guarded_entry<&destroy>(symbol::penumbra_destroy),
      guarded_entry<&add_surface>(symbol::add_surface),
      guarded_entry<&get_number_of_surfaces>(symbol::get_number_of_surfaces),
      guarded_entry<&set_model>(symbol::set_model),
      guarded_entry<&set_sun_position>(symbol::set_sun_position),
      guarded_entry<&submit_pssa>(symbol::submit_pssa),
      guarded_entry<&retrieve_pssa>(symbol::retrieve_pssa),
      guarded_entry<&calculate_interior_pssas>(symbol::calculate_interior_pssas),
  };
}

}  // namespace gpu_shading::energyplus
