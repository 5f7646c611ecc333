#ifndef GPU_SHADING_PENUMBRA_SURFACE_H
#define GPU_SHADING_PENUMBRA_SURFACE_H

#include <memory>
#include <string>
#include <vector>

namespace Penumbra {

// x, y, z of every vertex, one vertex after another; m, x east, y north, z up.
typedef std::vector<float> Polygon;

struct SurfaceContent;

// A planar surface. Copies share their content.
class Surface {
 public:
  Surface();
  // The outline runs counterclockwise as seen from the front.
  explicit Surface(Polygon const& polygon, std::string const& name = "");
  Surface(Surface const& surface);
  Surface& operator=(Surface const& surface);
  ~Surface();

  void add_hole(Polygon const& hole);

 private:
  friend class PenumbraImplementation;
  std::shared_ptr<SurfaceContent> content;
};

}  // namespace Penumbra

#endif
