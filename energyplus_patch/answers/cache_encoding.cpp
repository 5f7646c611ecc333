#include "answers/cache_encoding.h"

#include <algorithm>
#include <cstring>
#include <optional>
#include <string_view>
#include <unordered_map>

#include "gpu_shading/error.h"

namespace gpu_shading::energyplus {
namespace {

constexpr std::string_view magic = "GPUSHADE";
constexpr std::uint32_t format_version = 4;
constexpr std::size_t checksum_bytes = sizeof(Hash);
constexpr char const* damaged = "is damaged";

Hash checksum(std::span<std::byte const> bytes) {
  Digest digest;
  digest.add(bytes);
  return digest.result();
}

class Writer {
 public:
  template <typename T>
  void add(T value) {
    add(std::span<T const>(&value, 1));
  }
  template <typename T>
  void add(std::span<T const> values) {
    auto const bytes = std::as_bytes(values);
    bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
  }
  template <typename T>
  void add_list(std::vector<T> const& values) {
    add_count(values.size());
    add(std::span<T const>(values));
  }
  void add_count(std::size_t count) { add(std::uint64_t{count}); }

  std::vector<std::byte>& bytes() { return bytes_; }

 private:
  std::vector<std::byte> bytes_;
};

class Reader {
 public:
  explicit Reader(std::span<std::byte const> bytes) : bytes_(bytes) {}

  template <typename T>
  T take() {
    T value;
    take_into(std::span<T>(&value, 1));
    return value;
  }
  template <typename T>
  std::vector<T> take_list() {
    std::vector<T> values(take_count(sizeof(T)));
    take_into(std::span<T>(values));
    return values;
  }
  // A count of items, each of which takes at least this many bytes.
  std::size_t take_count(std::size_t bytes_each) {
    auto const count = take<std::uint64_t>();
    if (count > bytes_.size() / bytes_each) throw Error(damaged);
    return count;
  }
  bool at_end() const { return bytes_.empty(); }

 private:
  template <typename T>
  void take_into(std::span<T> values) {
    if (values.size_bytes() > bytes_.size()) throw Error(damaged);
    if (!values.empty()) std::memcpy(values.data(), bytes_.data(), values.size_bytes());
    bytes_ = bytes_.subspan(values.size_bytes());
  }

  std::span<std::byte const> bytes_;
};

void add(Writer& writer, std::vector<ScheduledPart> const& parts) {
  writer.add_count(parts.size());
  for (auto const& part : parts) {
    writer.add(part.projected_area);
    writer.add_count(part.powers.size());
    for (auto const& [schedule, power] : part.powers) {
      writer.add(std::int32_t{schedule});
      writer.add(std::int32_t{power});
    }
  }
}

std::vector<ScheduledPart> take_parts(Reader& reader) {
  std::vector<ScheduledPart> parts(reader.take_count(sizeof(double)));
  for (auto& part : parts) {
    part.projected_area = reader.take<double>();
    part.powers.resize(reader.take_count(2 * sizeof(std::int32_t)));
    for (auto& [schedule, power] : part.powers) {
      schedule = reader.take<std::int32_t>();
      power = reader.take<std::int32_t>();
    }
  }
  return parts;
}

void add(Writer& writer, AnswerStore::Direction const& direction) {
  writer.add(direction.sun.azimuth);
  writer.add(direction.sun.altitude);
  writer.add(direction.state);
  writer.add_list(direction.projected_area);
  writer.add_list(direction.errors);
  writer.add_count(direction.scheduled.size());
  for (auto const& [receiver, parts] : direction.scheduled) {
    writer.add(receiver);
    add(writer, parts);
  }
  writer.add_count(direction.interior.size());
  for (auto const& [question, answers] : direction.interior) {
    writer.add(question);
    writer.add(answers.error);
    writer.add_count(answers.count);
    for (auto const& answer : direction.sunlit(answers)) {
      writer.add(answer.projected_area);
      add(writer, answer.scheduled);
    }
  }
}

void take_direction(Reader& reader, SceneAnswers& set) {
  SunDirection sun;
  sun.azimuth = reader.take<double>();
  sun.altitude = reader.take<double>();
  auto const state = reader.take<std::uint32_t>();
  if (state >= set.states.size() || set.answers.find(sun, state) != nullptr) throw Error(damaged);
  auto& direction = set.answers.at(sun, state);
  AnswerStore::Direction unscheduled;
  unscheduled.projected_area = reader.take_list<float>();
  unscheduled.errors = reader.take_list<float>();
  auto const receivers = unscheduled.projected_area.size();
  if (receivers > set.receivers.size() || unscheduled.errors.size() > receivers)
    throw Error(damaged);
  std::unordered_map<ReceiverNumber, std::vector<ScheduledPart>> scheduled;
  for (auto left = reader.take_count(sizeof(ReceiverNumber)); left > 0; --left) {
    auto const receiver = reader.take<ReceiverNumber>();
    scheduled[receiver] = take_parts(reader);
  }
  for (ReceiverNumber receiver = 0; receiver < receivers; ++receiver) {
    Sunlit answer = unscheduled.sunlit(receiver);
    if (auto parts = scheduled.find(receiver); parts != scheduled.end()) {
      answer.scheduled = std::move(parts->second);
    }
    set.answers.keep(direction, receiver, std::move(answer));
  }
  std::optional<std::uint64_t> before;
  for (auto left = reader.take_count(sizeof(std::uint64_t)); left > 0; --left) {
    auto const question = reader.take<std::uint64_t>();
    // Out of order, adding each would take as long as there are others.
    if (before && question <= *before) throw Error(damaged);
    before = question;
    auto const error = error_of(reader.take<float>());
    std::vector<Sunlit> answers(reader.take_count(sizeof(double) + sizeof(std::uint64_t)));
    for (auto& answer : answers) {
      answer.projected_area = reader.take<double>();
      answer.scheduled = take_parts(reader);
      answer.error = error;
    }
    set.answers.keep_interior(direction, question, std::move(answers));
  }
}

void check_head(std::span<std::byte const> file, Hash const& scene) {
  Reader head(file);
  std::array<char, magic.size()> word{};
  for (char& letter : word) letter = head.take<char>();
  if (std::string_view(word.data(), word.size()) != magic) throw Error("is not a file of answers");
  if (head.take<std::uint32_t>() != format_version) throw Error("has another version");
  for (auto const byte : scene) {
    if (head.take<std::uint8_t>() != byte) throw Error("belongs to another scene");
  }
}

constexpr std::size_t head_bytes = magic.size() + sizeof format_version + sizeof(Hash);

}  // namespace

void add_answers(SceneAnswers const& from, SceneAnswers& to) {
  std::unordered_map<SurfaceId, ReceiverNumber> numbers;
  for (ReceiverNumber number = 0; number < to.receivers.size(); ++number) {
    numbers[to.receivers[number]] = number;
  }
  std::vector<ReceiverNumber> number_there;
  for (auto const receiver : from.receivers) {
    auto const [place, added] =
        numbers.try_emplace(receiver, static_cast<ReceiverNumber>(to.receivers.size()));
    if (added) to.receivers.push_back(receiver);
    number_there.push_back(place->second);
  }
  std::vector<std::uint32_t> state_there;
  for (std::uint32_t state = 0; state < from.states.size(); ++state) {
    state_there.push_back(to.states.number_of(from.states[state]));
  }
  from.answers.for_each([&](AnswerStore::Direction const& direction) {
    auto& there = to.answers.at(direction.sun, state_there[direction.state]);
    for (ReceiverNumber known = 0; known < direction.projected_area.size(); ++known) {
      auto const receiver = number_there[known];
      if (direction.knows(known) && !there.knows(receiver)) {
        to.answers.copy(direction, known, there, receiver);
      }
    }
    for (auto const& [question, answers] : direction.interior) {
      if (there.interior.contains(question)) continue;
      to.answers.keep_interior(there, question, direction.sunlit(answers));
    }
  });
}

void check_answers(SceneAnswers const& set, AnswerLimits const& limits) {
  auto const refuse = [] { throw Error("holds answers that are not possible"); };
  auto const& areas = limits.areas;
  for (auto const receiver : set.receivers) {
    if (receiver >= areas.size()) refuse();
  }
  // A question about interior surfaces is known by its hash only.
  double const largest = areas.empty() ? 0.0 : *std::ranges::max_element(areas);
  set.answers.for_each([&](AnswerStore::Direction const& direction) {
    for (ReceiverNumber number = 0; number < direction.projected_area.size(); ++number) {
      if (!direction.knows(number)) continue;
      if (!limits.allow(direction.sunlit(number), areas[set.receivers[number]])) refuse();
    }
    for (auto const& [question, answers] : direction.interior) {
      for (auto const& answer : direction.sunlit(answers)) {
        if (!limits.allow(answer, largest)) refuse();
      }
    }
  });
}

std::vector<std::byte> encode(SceneAnswers const& set, Hash const& scene) {
  Writer writer;
  writer.add(std::span<char const>(magic));
  writer.add(format_version);
  writer.add(std::span<std::uint8_t const>(scene));
  writer.add_list(set.receivers);
  writer.add_count(set.states.size());
  for (std::uint32_t state = 0; state < set.states.size(); ++state) {
    writer.add_list(set.states[state]);
  }
  writer.add_count(set.answers.size());
  set.answers.for_each([&](AnswerStore::Direction const& direction) { add(writer, direction); });
  writer.add(std::span<std::uint8_t const>(checksum(writer.bytes())));
  return std::move(writer.bytes());
}

SceneAnswers decode(std::span<std::byte const> file, Hash const& scene) {
  if (file.size() < head_bytes + checksum_bytes) throw Error(damaged);
  check_head(file, scene);
  auto const contents = file.first(file.size() - checksum_bytes);
  if (std::memcmp(checksum(contents).data(), file.last(checksum_bytes).data(), checksum_bytes) !=
      0) {
    throw Error(damaged);
  }
  Reader reader(contents.subspan(head_bytes));
  SceneAnswers set;
  set.receivers = reader.take_list<SurfaceId>();
  for (auto left = reader.take_count(sizeof(std::uint64_t)); left > 0; --left) {
    set.states.number_of(reader.take_list<double>());
  }
  for (auto left = reader.take_count(sizeof(SunDirection)); left > 0; --left) {
    take_direction(reader, set);
  }
  if (!reader.at_end()) throw Error(damaged);
  return set;
}

}  // namespace gpu_shading::energyplus
