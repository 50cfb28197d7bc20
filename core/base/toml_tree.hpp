#pragma once

#include <cstdint>
#include <list>
#include <set>
#include <string>
#include <string_view>

namespace vocalis::base {

/// One value of a TOML file with its place. A tree of our own, so that one source file alone has to compile the parser,
/// and so that values and tables can be changed (`--set`), marked as read, and written again.
struct TomlNode {
  enum class Kind { table, array, text, integer, real, boolean, other };

  Kind kind = Kind::table;
  std::string key;               ///< empty for the root and for items of an array
  std::string place;             ///< "case.toml:12" or "--set time.dt=1"
  std::string text;              ///< of a text; of anything else than table and array: as written
  double real = 0;               ///< of a real, and of an integer
  std::int64_t integer = 0;      ///< of an integer
  bool boolean = false;          ///< of a boolean
  std::list<TomlNode> children;  ///< entries of a table, items of an array, in the order of the file
  bool read = false;             ///< somebody asked for it
  bool by_default = false;       ///< not in the file: the reader's default
  std::string unit;              ///< as the reader said
  std::set<std::string> asked;   ///< of a table: all keys that a reader asked for
  std::string_view kind_name() const;
  TomlNode* find(std::string_view name);
  const TomlNode* find(std::string_view name) const;
};

/// The tree of a TOML text. Throws UserError with file, line and the parser's reason.
TomlNode parse_toml(std::string_view text, const std::string& file_name);

/// One value as TOML: text in quotes, numbers with all digits that matter, arrays and tables on one line.
std::string toml_value(const TomlNode& node);

/// The tree as a TOML text, with the unit of each value and the mark "default" in comments.
std::string write_toml(const TomlNode& root);

}  // namespace vocalis::base
