#pragma once

#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/base/toml_tree.hpp"

namespace vocalis::base {

/// The numbers that a key accepts. All must be finite besides.
struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool with_low = true;
  bool with_high = true;

  bool contains(double value) const;
  std::string words() const;  ///< "positive", "from 0.5 to 1", ...
};
inline const Range any_number = {};
inline const Range positive = {.low = 0, .with_low = false};
inline const Range not_negative = {.low = 0};
inline Range between(double low, double high) { return {.low = low, .high = high}; }
inline Range inside(double low, double high) { return {low, high, false, false}; }

/// Reads one table of a case file, strictly. Every answer is recorded in the tree, defaults included, so that the tree
/// afterwards is the resolved case, and a key that nobody asked for is found by `reject_unknown_keys`.
///
/// `x` needs the key, `x_or` takes the fallback where it is missing. Units are SI, `unit` is for messages and
/// resolved.toml. All throw UserError (file, line, key, rule; value; remedy). No rank talks to another here: all ranks
/// read the same tree.
class Table {
 public:
  /// The tree must outlive the table.
  explicit Table(TomlNode& root) : node_(&root) {}

  bool has(const std::string& key) const;
  bool is_array(const std::string& key) const;
  std::vector<std::string> keys() const;  ///< for tables whose keys are names that the user chooses

  double number(const std::string& key, const Range& range, const std::string& unit = "");
  double number_or(const std::string& key, double fallback, const Range& range, const std::string& unit = "");
  int integer(const std::string& key, const Range& range, const std::string& unit = "");
  int integer_or(const std::string& key, int fallback, const Range& range, const std::string& unit = "");
  bool boolean_or(const std::string& key, bool fallback);
  /// One of `allowed`, or any text when that list is empty; only an empty fallback may be written as "".
  std::string text(const std::string& key, const std::vector<std::string>& allowed = {});
  std::string text_or(const std::string& key, const std::string& fallback,
                      const std::vector<std::string>& allowed = {});
  /// One text or more, for example names of groups.
  std::vector<std::string> texts(const std::string& key);
  /// From `least` to `most` finite numbers, for example the coordinates of a point.
  std::vector<double> numbers(const std::string& key, std::size_t least, std::size_t most,
                              const std::string& unit = "");
  std::vector<double> numbers_or(const std::string& key, const std::vector<double>& fallback, std::size_t least,
                                 std::size_t most, const std::string& unit = "");

  /// What the resolved case shall say instead of what was written, for example an absolute path.
  void resolve_text(const std::string& key, const std::string& text);

  /// A value of an enumeration by its name in the file.
  template <class E>
  E choice(const std::string& key, const std::vector<std::pair<std::string, E>>& names);
  template <class E>
  E choice_or(const std::string& key, E fallback, const std::vector<std::pair<std::string, E>>& names);

  Table table(const std::string& key);                    ///< [key], needed
  std::optional<Table> table_if(const std::string& key);  ///< [key], if it is there
  Table table_or_empty(const std::string& key);           ///< [key], where all has defaults
  std::vector<Table> tables(const std::string& key);      ///< all [[key]], perhaps none

  /// Throws UserError for the first key in this table or below it that nobody asked for, with the nearest known name.
  void reject_unknown_keys() const;

  /// For rules over several keys: "case.toml:12: flow.boundary[inlet].ramp" (the table itself when `key` is empty).
  std::string place(const std::string& key = "") const;
  std::string path(const std::string& key = "") const;

 private:
  Table(TomlNode& node, std::string path) : node_(&node), path_(std::move(path)) {}
  TomlNode* find(const std::string& key) const;
  TomlNode& need(const std::string& key, const std::string& unit) const;
  TomlNode& add_default(const std::string& key, const std::string& unit) const;

  TomlNode* node_;
  std::string path_;
};

/// The name nearest to `word` by edit distance, empty if none is near enough to be meant.
std::string nearest_name(const std::string& word, const std::vector<std::string>& names);

/// "a, b, c"
std::string list_of(const std::vector<std::string>& names);

/// "did you mean "b"?", or else "choose one of a, b, c"
std::string did_you_mean(const std::string& word, const std::vector<std::string>& names);

template <class E>
E Table::choice(const std::string& key, const std::vector<std::pair<std::string, E>>& names) {
  std::vector<std::string> allowed;
  for (const auto& [name, value] : names) allowed.push_back(name);
  const std::string chosen = text(key, allowed);
  for (const auto& [name, value] : names) {
    if (name == chosen) return value;
  }
  return names.front().second;  // not reached: text() accepts nothing else
}

template <class E>
E Table::choice_or(const std::string& key, E fallback, const std::vector<std::pair<std::string, E>>& names) {
  if (!has(key)) {
    for (const auto& [name, value] : names) {
      if (value == fallback) text_or(key, name);
    }
    return fallback;
  }
  return choice(key, names);
}

}  // namespace vocalis::base
