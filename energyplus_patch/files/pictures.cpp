#include "files/pictures.h"

#include <dlfcn.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cmath>
#include <system_error>

#include "files/picture_plugin/picture_plugin.h"
#include "files/sibling_file.h"
#include "gpu_shading/error.h"
#include "gpu_shading/scene_view.h"
#include "platform/text.h"

namespace gpu_shading::energyplus {
namespace {

[[noreturn]] void fail() {
  throw Error(fmt::format("no memory for a picture ({})", std::generic_category().message(errno)));
}

// A file in memory with a path, for libraries that write to a path and do not check every write.
class MemoryFile {
 public:
  MemoryFile() : descriptor_(memfd_create("picture", MFD_CLOEXEC)) {
    if (descriptor_ < 0) fail();
  }
  MemoryFile(MemoryFile const&) = delete;
  MemoryFile& operator=(MemoryFile const&) = delete;
  ~MemoryFile() { close(descriptor_); }

  // Valid in this process.
  std::string path() const { return fmt::format("/proc/self/fd/{}", descriptor_); }

  std::string contents() const {
    struct stat found {};
    if (fstat(descriptor_, &found) != 0) fail();
    std::string bytes(static_cast<std::size_t>(found.st_size), '\0');
    for (std::size_t done = 0; done < bytes.size();) {
      auto const count =
          pread(descriptor_, bytes.data() + done, bytes.size() - done, static_cast<off_t>(done));
      if (count <= 0) fail();
      done += static_cast<std::size_t>(count);
    }
    return bytes;
  }

 private:
  int descriptor_;
};

// A function of the picture plugin, which is beside this module or program. It is loaded with its
// dependencies at the first call, with its symbols kept local.
void* plugin_function(char const* name) {
  auto const path = sibling_file(gpu_shading_picture_library);
  void* const handle = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (handle == nullptr) {
    throw Error(fmt::format("pictures need {}: {}{}", gpu_shading_picture_library, dlerror(),
                            formats_package(path)));
  }
  void* const function = dlsym(handle, name);
  if (function == nullptr) throw Error(fmt::format("{}: {}", path.string(), dlerror()));
  return function;
}

// What `write(path, message, size)` writes, which returns 0 if it succeeds.
template <typename Write>
std::string contents_of(std::string const& name, Write const& write) {
  MemoryFile const file;
  std::array<char, 512> message{};
  if (write(file.path().c_str(), message.data(), message.size()) != 0) {
    throw Error(fmt::format("{}: cannot be drawn: {}", name, message.data()));
  }
  return file.contents();
}

// By a function of the picture plugin that takes one structure.
template <typename Function, typename Picture>
std::string write_picture(char const* function, std::string const& name, Picture const& picture) {
  auto* const write = reinterpret_cast<Function*>(plugin_function(function));
  return contents_of(name, [&](char const* path, char* message, std::size_t size) {
    return write(path, name.c_str(), &picture, message, size);
  });
}

std::vector<unsigned char> scale_colours() {
  std::vector<unsigned char> colours;
  for (int i = 0; i < gpu_shading_scale_colours; ++i) {
    auto const colour = fraction_colour(i / (gpu_shading_scale_colours - 1.0));
    for (int channel = 0; channel < 3; ++channel) {
      colours.push_back(static_cast<unsigned char>(std::lround(colour[channel])));
    }
  }
  return colours;
}

}  // namespace

std::string encode_image(std::string const& name, Image const& image) {
  static auto const write = reinterpret_cast<decltype(&gpu_shading_write_image)>(
      plugin_function("gpu_shading_write_image"));
  return contents_of(name, [&](char const* path, char* message, std::size_t size) {
    return write(path, name.c_str(), image.width, image.height, image.channels, image.pixels.data(),
                 message, size);
  });
}

std::string encode_labelled(std::string const& name, Image const& image,
                            std::vector<Label> const& labels) {
  std::vector<gpu_shading_label> plain;
  plain.reserve(labels.size());
  for (auto const& label : labels) {
    plain.push_back(
        {label.text.c_str(), label.x, label.y, label.size, static_cast<int>(label.align)});
  }
  gpu_shading_labelled const all{image.width, image.height, image.pixels.data(),
                                 static_cast<int>(plain.size()), plain.data()};
  return write_picture<decltype(gpu_shading_write_labelled)>("gpu_shading_write_labelled", name,
                                                             all);
}

bool is_animation(std::filesystem::path const& path) {
  return same_name(path.extension().string(), ".gif");
}

std::string encode_sheet(std::string const& name, PictureSheet const& sheet) {
  std::vector<char const*> pictures;
  std::vector<char const*> captions;
  for (auto const& item : sheet.items) {
    pictures.push_back(item.picture.c_str());
    captions.push_back(item.caption.c_str());
  }
  auto const scale = scale_colours();
  constexpr int columns = SheetLayout::max_columns;
  constexpr float frames_per_second = 8.0F;
  gpu_shading_sheet const all{static_cast<int>(sheet.items.size()),
                              pictures.data(),
                              captions.data(),
                              sheet.scale ? scale.data() : nullptr,
                              columns,
                              is_animation(name) ? 1 : 0,
                              frames_per_second};
  return write_picture<decltype(gpu_shading_write_sheet)>("gpu_shading_write_sheet", name, all);
}

}  // namespace gpu_shading::energyplus
