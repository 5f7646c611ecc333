#include "model/site/calendar_date.h"

#include <fmt/format.h>

#include <array>
#include <cctype>
#include <cstdlib>
#include <string>
#include <vector>

#include "gpu_shading/error.h"
#include "platform/text.h"

namespace gpu_shading::energyplus {
namespace {

namespace chrono = std::chrono;

// Runs of letters and runs of digits; "1st" is two.
std::vector<std::string> words_of(std::string_view text) {
  auto const kind = [](char c) {
    auto const letter = static_cast<unsigned char>(c);
    return std::isdigit(letter) != 0 ? 1 : std::isalpha(letter) != 0 ? 2 : 0;
  };
  std::vector<std::string> words;
  int last = 0;
  for (char const c : text) {
    if (kind(c) != 0) {
      if (kind(c) != last) words.emplace_back();
      words.back() += c;
    }
    last = kind(c);
  }
  return words;
}

std::optional<unsigned> number_of(std::string const& word) {
  constexpr std::size_t most = 4;  // digits
  if (word.size() > most || std::isdigit(static_cast<unsigned char>(word.front())) == 0) return {};
  return static_cast<unsigned>(std::strtoul(word.c_str(), nullptr, 10));
}

// Index of a month or weekday by its first three letters, from 0.
template <std::size_t count>
std::optional<unsigned> find(std::array<char const*, count> const& names, std::string_view word) {
  for (unsigned i = 0; i < count; ++i) {
    if (same_name(word.substr(0, 3), names.at(i))) return i;
  }
  return {};
}

std::optional<chrono::month> month_of(std::string const& word) {
  static constexpr std::array<char const*, 12> names{"jan", "feb", "mar", "apr", "may", "jun",
                                                     "jul", "aug", "sep", "oct", "nov", "dec"};
  auto const found = find(names, word);
  return found ? std::optional(chrono::month(*found + 1)) : std::nullopt;
}

// "[2] [nd] Sunday in March", or "Last" instead of the number.
std::optional<chrono::year_month_day> weekday_in(std::vector<std::string> const& words,
                                                 chrono::year year) {
  if (words.size() < 4 || !same_name(words[words.size() - 2], "in")) return {};
  auto const weekday = weekday_of(words[words.size() - 3]);
  auto const month = month_of(words.back());
  if (!weekday || !month) return {};
  if (same_name(words.front(), "last")) {
    return chrono::year_month_day(chrono::sys_days(year / *month / (*weekday)[chrono::last]));
  }
  auto const nth = number_of(words.front());
  if (!nth || *nth < 1 || *nth > 5) return {};
  auto const day = year / *month / (*weekday)[*nth];
  return day.ok() ? std::optional(chrono::year_month_day(chrono::sys_days(day))) : std::nullopt;
}

std::optional<chrono::year_month_day> read(std::vector<std::string> const& words,
                                           chrono::year year) {
  if (words.size() == 2) {
    auto const first = number_of(words[0]);
    auto const second = number_of(words[1]);
    if (first && second) return year / chrono::month(*first) / chrono::day(*second);
    auto const month = month_of(words[first ? 1 : 0]);
    auto const day = first ? first : second;
    if (month && day) return year / *month / chrono::day(*day);
  }
  return weekday_in(words, year);
}

}  // namespace

std::optional<chrono::weekday> weekday_of(std::string_view word) {
  static constexpr std::array<char const*, 7> names{"sun", "mon", "tue", "wed",
                                                    "thu", "fri", "sat"};
  auto const found = find(names, word);
  return found ? std::optional(chrono::weekday(*found)) : std::nullopt;
}

std::chrono::year_month_day date_in(std::string_view text, std::chrono::year year) {
  auto const date = read(words_of(text), year);
  if (!date || !date->ok()) {
    throw Error(fmt::format(
        "\"{}\" is not a day of {}, expected one as in 4/30, 30 April or Last Sunday in October",
        text, static_cast<int>(year)));
  }
  return *date;
}

}  // namespace gpu_shading::energyplus
