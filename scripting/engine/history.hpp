#pragma once

#include <filesystem>
#include <string>

#include <histedit.h>

namespace springlod::scripting {

/// The chunks that were entered at the prompt, in memory and in a file. Each is written as soon as
/// it is entered, so that it is kept however the process ends; several prompts may share the file.
/// Failures to write are ignored: they must not stop the prompt.
class PromptHistory {
 public:
  /// Loads `file`, and shortens it to the last chunks if it has grown long. A file that is not a
  /// history is moved aside to `file`.damaged. An empty path: memory only.
  explicit PromptHistory(std::filesystem::path file);
  ~PromptHistory();
  PromptHistory(const PromptHistory&) = delete;
  PromptHistory& operator=(const PromptHistory&) = delete;

  void add(const std::string& chunk);

  /// For EL_HIST of libedit.
  History* handle() const { return history_; }

 private:
  void load();
  void append(const std::string& chunk) const;

  std::filesystem::path file_;
  History* history_;
  std::string last_;
};

}  // namespace springlod::scripting
