#include "platform/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <utility>

#include "platform/console.h"

namespace gpu_shading::energyplus {

Progress::Progress(std::string work, std::size_t total, int descriptor)
    : work_(std::move(work)), total_(total) {
  if (descriptor >= 0) own_.reset(fdopen(dup(descriptor), "w"));
  if (own_) out_ = own_.get();
  terminal_ = isatty(fileno(out_)) != 0;
}

Progress::Progress(std::string work, std::size_t total, std::FILE* out, bool terminal,
                   Clock::duration patience)
    : work_(std::move(work)), total_(total), out_(out), terminal_(terminal), patience_(patience) {}

Progress::~Progress() {
  if (drawn_) std::fputc('\n', out_);
}

void Progress::at(std::size_t done) {
  constexpr int all = 100;
  constexpr int tenth = 10;
  if (total_ == 0 || is_quiet()) return;
  int const percent = static_cast<int>(done * all / total_);
  int const next = terminal_ ? shown_ + 1 : shown_ / tenth * tenth + tenth;
  if (percent < next || Clock::now() - start_ < patience_) return;
  shown_ = percent;
  if (terminal_) {
    draw_bar(percent);
    drawn_ = true;
  } else {
    fmt::print(out_, "gpu_shading: {}: {} %\n", work_, percent / tenth * tenth);
  }
  std::fflush(out_);
}

void Progress::draw_bar(int percent) const {
  constexpr int width = 40;
  constexpr int all = 100;
  int const full = percent * width / all;
  fmt::print(out_, "\rgpu_shading: {} [{:#<{}}{:.<{}}] {:3} %", work_, "", full, "", width - full,
             percent);
}

}  // namespace gpu_shading::energyplus
