#pragma once

// The files of parts/ and the library for drawings in 3D, compiled in by embed_page.cmake.
namespace gpu_shading::energyplus::page_parts {

extern char const* const page_html;
extern char const* const page_css;
extern char const* const scripts;
extern char const* const three_js;  // empty if the build has none

}  // namespace gpu_shading::energyplus::page_parts
