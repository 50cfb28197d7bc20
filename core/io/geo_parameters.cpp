#include "core/io/geo_parameters.hpp"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace vocalis::io {

namespace {

/// The text with comments replaced by spaces; what stands in quotes is left alone.
std::string without_comments(const std::string& text) {
  std::string result;
  for (std::size_t i = 0; i < text.size();) {
    std::size_t end = i + 1;
    bool is_comment = false;
    if (text[i] == '"') {
      end = text.find('"', i + 1);
      end = end == std::string::npos ? text.size() : end + 1;
    } else if (text.compare(i, 2, "//") == 0) {
      is_comment = true;
      end = std::min(text.find('\n', i), text.size());
    } else if (text.compare(i, 2, "/*") == 0) {
      is_comment = true;
      end = text.find("*/", i + 2);
      end = end == std::string::npos ? text.size() : end + 2;
    }
    result += is_comment ? " " : text.substr(i, end - i);
    i = end;
  }
  return result;
}

std::string name_at(const std::string& text, std::size_t& i) {
  while (i < text.size() && std::isspace(static_cast<unsigned char>(text[i]))) ++i;
  const std::size_t start = i;
  while (i < text.size() && (std::isalnum(static_cast<unsigned char>(text[i])) || text[i] == '_')) ++i;
  return text.substr(start, i - start);
}

/// The names of one list, from behind its opening bracket: what follows each comma outside of inner brackets.
void read_list(const std::string& text, std::size_t i, std::vector<std::string>& names) {
  int depth = 0;
  bool name_is_next = true;
  for (; i < text.size() && depth >= 0; ++i) {
    if (name_is_next) {
      const std::string name = name_at(text, i);
      if (!name.empty()) names.push_back(name);
      name_is_next = false;
      if (i >= text.size()) return;
    }
    const char c = text[i];
    if (c == '"') i = std::min(text.find('"', i + 1), text.size());
    if (c == '[' || c == '{' || c == '(') ++depth;
    if (c == ']' || c == '}' || c == ')') --depth;
    if (c == ',' && depth == 0) name_is_next = true;
  }
}

std::string read_without_comments(const std::string& path) {
  std::ifstream file(path);
  return without_comments({std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()});
}

void collect_files(const std::filesystem::path& path, std::vector<std::string>& files) {
  const std::string name = path.lexically_normal().string();
  if (!std::ifstream(name) || std::find(files.begin(), files.end(), name) != files.end()) return;
  files.push_back(name);
  const std::string text = read_without_comments(name);
  for (const std::string word : {"Include", "Merge"}) {
    for (std::size_t at = 0; (at = text.find(word, at)) != std::string::npos; at += word.size()) {
      const std::size_t start = text.find_first_not_of(" \t", at + word.size());
      if (start == std::string::npos || text[start] != '"') continue;
      const std::size_t end = text.find('"', start + 1);
      if (end != std::string::npos) collect_files(path.parent_path() / text.substr(start + 1, end - start - 1), files);
    }
  }
}

}  // namespace

std::vector<std::string> geo_files(const std::string& path) {
  std::vector<std::string> files;
  collect_files(path, files);
  return files;
}

std::vector<std::string> geo_parameters(const std::string& path) {
  std::vector<std::string> names;
  for (const std::string& file : geo_files(path)) {
    const std::string text = read_without_comments(file);
    for (std::size_t at = 0; (at = text.find("DefineConstant", at)) != std::string::npos;) {
      at = text.find_first_of("[(", at);
      if (at == std::string::npos) break;
      read_list(text, ++at, names);
    }
  }
  return names;
}

}  // namespace vocalis::io
