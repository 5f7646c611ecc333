#include <penumbra/surface.h>

#include "routes/penumbra/drop_in/surface_content.h"

namespace Penumbra {

Surface::Surface() : content(std::make_shared<SurfaceContent>()) {}

Surface::Surface(Polygon const& polygon, std::string const& name)
    : content(std::make_shared<SurfaceContent>(SurfaceContent{{name, polygon, {}}})) {}

Surface::Surface(Surface const& surface) = default;

Surface& Surface::operator=(Surface const& surface) = default;

Surface::~Surface() = default;

void Surface::add_hole(Polygon const& hole) { content->surface.holes.push_back(hole); }

}  // namespace Penumbra
