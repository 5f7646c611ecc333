#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <sstream>
#include <string>
#include <system_error>
#include <vector>

#include "files/picture_plugin/picture_plugin.h"
#include "files/picture_plugin/sheet_layout.h"
#include "platform/c_interface.h"

namespace {

using OIIO::ImageBuf;
using OIIO::ImageBufAlgo::TextAlignX;
using OIIO::ImageBufAlgo::TextAlignY;

constexpr std::array<float, 3> white{1.0F, 1.0F, 1.0F};
constexpr std::array<float, 3> black{0.0F, 0.0F, 0.0F};

using Layout = gpu_shading::SheetLayout;

std::vector<std::string> lines_of(char const* text) {
  std::istringstream all(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(all, line);) lines.push_back(line);
  return lines;
}

// Of all pictures together or, in an animation, of each alone; all frames have one size.
Layout layout_of(std::vector<ImageBuf> const& pictures, gpu_shading_sheet const& sheet) {
  std::vector<gpu_shading::PictureSize> sizes;
  for (auto const& picture : pictures) {
    gpu_shading::PictureSize const size{picture.spec().width, picture.spec().height};
    if (sheet.animated == 0 || sizes.empty()) {
      sizes.push_back(size);
    } else {
      sizes.front() = {std::max(sizes.front().width, size.width),
                       std::max(sizes.front().height, size.height)};
    }
  }
  gpu_shading::CaptionSize captions;
  for (int i = 0; i < sheet.count; ++i) captions.add(sheet.captions[i]);
  return {sizes, sheet.columns, captions, sheet.scale != nullptr};
}

void check(bool done, ImageBuf const& image) {
  if (!done) fail(image.geterror());
}

ImageBuf blank(int width, int height) {
  ImageBuf image(OIIO::ImageSpec(width, height, 3, OIIO::TypeDesc::UINT8));
  check(OIIO::ImageBufAlgo::fill(image, white), image);
  return image;
}

// The file of DejaVu Sans or, without that, of another font; empty where there is none. Given a
// name, OpenImageIO would look in the current folder first, where anybody's file may lie.
std::string find_font() {
  namespace fs = std::filesystem;
  std::string other;
  for (auto const* const folder : {"/usr/share/fonts", "/usr/local/share/fonts"}) {
    std::error_code ignored;
    for (fs::recursive_directory_iterator entry(folder, ignored), end; !ignored && entry != end;
         entry.increment(ignored)) {
      auto const& path = entry->path();
      if (path.filename() == "DejaVuSans.ttf") return path.string();
      // The first by its name, so that pictures are the same from run to run.
      if (path.extension() == ".ttf" && (other.empty() || path.string() < other)) {
        other = path.string();
      }
    }
  }
  return other;
}

// A picture is of use without its captions.
void warn_of_missing_font() {
  static bool const told = [] {
    std::fputs(
        "gpu_shading: warning: no font was found, so that pictures have no captions (Debian: "
        "fonts-dejavu-core)\n",
        stderr);
    return true;
  }();
  static_cast<void>(told);
}

void write(ImageBuf& on, int x, int y, std::string const& text, int size, TextAlignX align) {
  static std::string const font = find_font();
  bool const written =
      !font.empty() &&
      OIIO::ImageBufAlgo::render_text(on, x, y, text, size, font, black, align, TextAlignY::Center);
  if (written) return;
  static_cast<void>(on.geterror());  // forgotten
  warn_of_missing_font();
}

void add_scale(ImageBuf& on, Layout const& layout, unsigned char const* colours) {
  constexpr int shades = gpu_shading_scale_colours;
  int const left = layout.bar_left();
  int const wide = layout.text;
  int const top = layout.bar_top();
  int const tall = layout.bar_height();
  for (int y = 0; y < tall; ++y) {
    auto const shade = static_cast<std::size_t>((tall - 1 - y) * (shades - 1) / (tall - 1));
    std::array<float, 3> colour{};
    for (std::size_t channel = 0; channel < 3; ++channel) {
      constexpr float full = 255.0F;
      colour.at(channel) = static_cast<float>(colours[3 * shade + channel]) / full;
    }
    OIIO::ROI const row(left, left + wide, top + y, top + y + 1, 0, 1, 0, 3);
    check(OIIO::ImageBufAlgo::fill(on, colour, row), on);
  }
  constexpr int steps = 4;
  for (int step = 0; step <= steps; ++step) {
    auto const number = step == 0 ? "0" : step == steps ? "1" : step == 2 ? "0.5" : "";
    write(on, left + wide + layout.margin, top + tall - tall * step / steps, number, layout.text,
          TextAlignX::Left);
  }
  write(on, left, layout.caption - layout.text / 2, "sunlit", layout.text, TextAlignX::Left);
}

void add_picture(ImageBuf& on, ImageBuf const& picture, char const* caption, std::size_t cell,
                 Layout const& layout) {
  int number = 0;
  for (auto const& line : lines_of(caption)) {
    write(on, layout.left(cell) + layout.cell_width / 2, layout.line_middle(cell, number), line,
          layout.text, TextAlignX::Center);
    ++number;
  }
  auto const& spec = picture.spec();
  check(OIIO::ImageBufAlgo::paste(on, layout.picture_left(cell, spec.width),
                                  layout.picture_top(cell, spec.height), 0, 0, picture),
        on);
}

void write_frames(char const* path, char const* name, std::vector<ImageBuf> const& frames,
                  float per_second) {
  auto const output = OIIO::ImageOutput::create(name);
  if (!output) fail(OIIO::geterror());
  if (frames.size() > 1 && output->supports("multiimage") == 0) {
    fail("its format does not support animation; use .gif");
  }
  std::vector<OIIO::ImageSpec> specs;
  for (auto const& frame : frames) {
    specs.push_back(frame.spec());
    specs.back().attribute("FramesPerSecond", per_second);
  }
  bool good = frames.size() > 1 ? output->open(path, static_cast<int>(specs.size()), specs.data())
                                : output->open(path, specs.front());
  for (std::size_t i = 0; good && i < frames.size(); ++i) {
    if (i > 0) good = output->open(path, specs[i], OIIO::ImageOutput::AppendSubimage);
    good = good && output->write_image(OIIO::TypeDesc::UINT8, frames[i].localpixels());
  }
  if (!good || !output->close()) fail(output->geterror());
}

TextAlignX align_of(int align) {
  constexpr std::array<TextAlignX, 3> known{TextAlignX::Left, TextAlignX::Center,
                                            TextAlignX::Right};
  return known.at(static_cast<std::size_t>(align));
}

}  // namespace

extern "C" EXPORTED int gpu_shading_write_labelled(char const* path, char const* name,
                                                   gpu_shading_labelled const* picture,
                                                   char* message, std::size_t message_size) {
  return guarded(message, message_size, [&] {
    std::vector<ImageBuf> frames;
    auto& image = frames.emplace_back(blank(picture->width, picture->height));
    auto const all = OIIO::get_roi(image.spec());
    check(image.set_pixels(all, OIIO::TypeDesc::UINT8, picture->pixels), image);
    for (int i = 0; i < picture->count; ++i) {
      auto const& label = picture->labels[i];
      write(image, label.x, label.y, label.text, label.size, align_of(label.align));
    }
    constexpr float unused = 1.0F;  // of a picture that is not animated
    write_frames(path, name, frames, unused);
  });
}

extern "C" EXPORTED int gpu_shading_write_sheet(char const* path, char const* name,
                                                gpu_shading_sheet const* sheet, char* message,
                                                std::size_t message_size) {
  return guarded(message, message_size, [&] {
    std::vector<ImageBuf> pictures;
    for (int i = 0; i < sheet->count; ++i) {
      pictures.emplace_back(sheet->pictures[i]);
      check(pictures.back().read(0, 0, true, OIIO::TypeDesc::UINT8), pictures.back());
    }
    auto const layout = layout_of(pictures, *sheet);
    std::vector<ImageBuf> frames;
    std::size_t const each = sheet->animated != 0 ? 1 : pictures.size();
    for (std::size_t first = 0; first < pictures.size(); first += each) {
      auto frame = blank(layout.sheet_width(), layout.sheet_height());
      for (std::size_t i = 0; i < each; ++i) {
        add_picture(frame, pictures[first + i], sheet->captions[first + i], i, layout);
      }
      if (sheet->scale != nullptr) add_scale(frame, layout, sheet->scale);
      frames.push_back(std::move(frame));
    }
    write_frames(path, name, frames, sheet->frames_per_second);
  });
}
