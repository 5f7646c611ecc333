#include "backends/opengl/raster/submissions.h"

#include <algorithm>

#include "backends/opengl/gl/check.h"
#include "platform/stopwatch.h"

namespace gpu_shading {
namespace {

// Limit of the collected lists; a single view may take more.
constexpr std::size_t max_bytes = std::size_t{16} << 20U;

}  // namespace

std::size_t Submissions::add(Kind kind, int side, std::size_t parts, Gather const& gather) {
  Range const answer{sums_.size(), parts};
  views_.push_back(answer);
  sums_.resize(sums_.size() + parts);
  Group const group{kind, side};
  Batch& batch = gathered_[group];
  {
    Stopwatch const watch(statistics_.submit_seconds);
    gather(batch.list, static_cast<int>(batch.answers.size()));
  }
  batch.answers.push_back(answer);
  if (batch.answers.size() == static_cast<std::size_t>(targets_.max_layers(kind, side))) {
    submit(group, batch);
  } else if (batch.list.bytes() > max_bytes / 16) {
    submit_largest();
  }
  return views_.size() - 1;
}

void Submissions::submit_largest() {
  std::size_t all = 0;
  auto largest = gathered_.begin();
  for (auto entry = gathered_.begin(); entry != gathered_.end(); ++entry) {
    std::size_t const bytes = entry->second.list.bytes();
    all += bytes;
    if (bytes > largest->second.list.bytes()) largest = entry;
  }
  if (all > max_bytes) submit(largest->first, largest->second);
}

void Submissions::submit(Group const& group, Batch& batch) {
  while (in_flight_.size() >= max_in_flight_) collect();
  auto const layers = static_cast<int>(batch.answers.size());
  Target* target = targets_.take(group.first, group.second, layers);
  while (target == nullptr) {
    collect();
    target = targets_.take(group.first, group.second, layers);
  }
  Stopwatch const watch(statistics_.submit_seconds);
  DrawList& list = batch.list;
  if (!list.screen_draws().empty()) {
    list.set_sheets(geometry_.screens().sheets(list, transmission_));
  }
  geometry_.upload(list);
  std::size_t parts = 0;
  for (Range const& answer : batch.answers) parts = std::max(parts, answer.count);
  target->draw(geometry_, layers, parts);
  gl::check("drawing views");
  in_flight_.push_back({target, std::move(batch.answers), gl::Fence::here()});
  batch.answers.clear();
  list.clear();
}

void Submissions::collect() {
  InFlight& first = in_flight_.front();
  {
    Stopwatch const watch(statistics_.wait_seconds);
    first.fence.wait();
  }
  Stopwatch const watch(statistics_.read_seconds);
  for (std::size_t layer = 0; layer < first.answers.size(); ++layer) {
    Range const& answer = first.answers[layer];
    first.target->read(static_cast<int>(layer), {sums_.data() + answer.first, answer.count});
  }
  gl::check("summing views");
  targets_.give_back(first.target);
  in_flight_.pop_front();
}

void Submissions::finish() {
  for (auto& [group, batch] : gathered_) {
    if (!batch.answers.empty()) submit(group, batch);
  }
  while (!in_flight_.empty()) collect();
}

std::span<LuminanceByKey const> Submissions::sums(std::size_t view) const {
  return {sums_.data() + views_[view].first, views_[view].count};
}

void Submissions::clear() {
  for (auto& [group, batch] : gathered_) {
    batch.list.clear();
    batch.answers.clear();
  }
  in_flight_.clear();
  targets_.give_all_back();
  views_.clear();
  sums_.clear();
}

}  // namespace gpu_shading
