#pragma once

#include <span>

#include "reports/page/run_page.h"
#include "reports/position_record.h"
#include "reports/run_record.h"
#include "scene/scene_assembly.h"

namespace gpu_shading::energyplus {

// Adds where the surfaces of moving shades stand at the page's hours. `ids`: of the page's
// surfaces.
void add_motions(RunPage& page, SceneAssembly const& assembly, std::span<SurfaceId const> ids,
                 RunDay::Kind kind, PositionRecord const& record);

}  // namespace gpu_shading::energyplus
