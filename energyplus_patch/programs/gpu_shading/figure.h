#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <iosfwd>
#include <string>
#include <variant>
#include <vector>

#include "files/pictures.h"

namespace gpu_shading::energyplus {

// A drawing that becomes a vector picture or an image. Positions are in pixels from the upper left
// corner, colours red, green and blue, 0 .. 255; later shapes cover earlier ones.
class Figure {
 public:
  Figure(int width, int height) : width_(width), height_(height) {}

  void area(std::vector<glm::dvec2> outline, glm::dvec3 const& colour);
  void line(std::vector<glm::dvec2> points, double width, glm::dvec3 const& colour);
  void disc(glm::dvec2 const& centre, double radius, glm::dvec3 const& colour);
  void box(glm::dvec2 const& corner, glm::dvec2 const& size, glm::dvec3 const& colour);
  void text(glm::dvec2 const& place, int size, LabelAlign align, std::string text);

  // `title` and `description` may be any text.
  void write_svg(std::string const& title, std::string const& description, std::ostream& svg) const;
  // The ending of `name` is the format. Throws Error.
  std::string encode(std::string const& name) const;

 private:
  struct Area {
    std::vector<glm::dvec2> outline;
    glm::dvec3 colour;
  };
  struct Line {
    std::vector<glm::dvec2> points;
    double width;
    glm::dvec3 colour;
  };
  struct Disc {
    glm::dvec2 centre;
    double radius;
    glm::dvec3 colour;
  };

  int width_;
  int height_;
  std::vector<std::variant<Area, Line, Disc>> shapes_;
  std::vector<Label> labels_;
};

}  // namespace gpu_shading::energyplus
