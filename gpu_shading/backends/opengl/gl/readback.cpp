#include "backends/opengl/gl/readback.h"

#include "backends/opengl/gl/draw.h"

namespace gpu_shading::gl {

Readback::Readback(LayeredTexture const& texture, Way way) : texture_(texture) {
  if (way == Way::ahead) {
    buffer_ = Buffer::create();
    ahead_ = buffer_.set_shared_size(bytes(texture, way));
  } else {
    asked_.resize(bytes(texture, way));
  }
}

std::size_t Readback::bytes(LayeredTexture const& texture, Way way) {
  return texture.layer_size() *
         (way == Way::ahead ? static_cast<std::size_t>(texture.layers()) : 1);
}

void Readback::start(int layers) {
  if (ahead_ == nullptr) return;
  texture_.copy(layers, buffer_);
  share_written();
}

std::byte const* Readback::find(int layer) {
  if (ahead_ != nullptr) return ahead_ + texture_.layer_size() * static_cast<std::size_t>(layer);
  texture_.read(layer, asked_);
  return asked_.data();
}

}  // namespace gpu_shading::gl
