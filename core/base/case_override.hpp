#pragma once

#include <string>

#include "core/base/toml_tree.hpp"

namespace vocalis::base {

/// Changes a tree by one "a.b.c=value" of the command line. The value is TOML; what is not valid TOML is a text, so
/// `acoustic.analogy=none` needs no quotes. Within an array of tables the next part of the key is an index from 0, or
/// the `name` or `group` of one table; left out, it means all of them. Tables that are missing are made, so that a key
/// that nobody reads is found by `Table::reject_unknown_keys`.
/// Throws UserError if the text is no assignment, or names an element that the case does not have.
void apply_override(TomlNode& root, const std::string& assignment);

}  // namespace vocalis::base
