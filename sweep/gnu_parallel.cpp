#include "sweep/gnu_parallel.hpp"

#include <system_error>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include "base/error.hpp"
#include "base/file.hpp"
#include "base/subprocess.hpp"
#include "sweep/task_list.hpp"

namespace springlod::sweep {

namespace fs = std::filesystem;

std::vector<std::vector<std::string>> parallel_calls(const Plan& plan, const fs::path& folder,
                                                     const std::vector<std::size_t>& tasks,
                                                     const ParallelOptions& options) {
  std::vector<std::vector<std::string>> calls;
  for (const PhaseTasks& some : by_phase(plan, tasks, tasks.size())) {
    const fs::path list = write_task_list(folder, some.tasks);
    std::vector<std::string> call{"--plain", "--will-cite"};
    if (some.alone) call.insert(call.end(), {"--jobs", "1"});
    if (!options.hosts.empty())
      call.insert(call.end(), {"--sshloginfile", fs::absolute(options.hosts).string()});
    call.insert(call.end(),
                {"--workdir", folder.string(), "--joblog",
                 fs::path(list).replace_extension(".log").string(), "--arg-file", list.string(),
                 shell_line(options.program.string(),
                            {"--quiet", "sweep", "run", folder.string(), "--task"}) +
                     " {}"});
    calls.push_back(std::move(call));
  }
  return calls;
}

std::string parallel_script(const std::vector<std::vector<std::string>>& calls) {
  std::string script = "#!/bin/sh\n";
  for (const std::vector<std::string>& call : calls) script += shell_line("parallel", call) + "\n";
  return script;
}

int run_parallel(const std::vector<std::vector<std::string>>& calls) {
  const auto program = find_program("parallel");
  if (!program)
    throw IoError(
        "GNU parallel is not installed (Debian's package parallel); without other "
        "machines, 'springlod sweep run' uses all cores of this one");
  // Its exit code: the number of jobs that failed, up to 100; 101: more; 255: it failed itself.
  constexpr int kMostFailures = 101;
  int failures = 0;
  for (const std::vector<std::string>& call : calls) {
    const ProcessEnd end = wait_for_program(
        start_program(*program, call, {.output = STDOUT_FILENO, .errors = STDERR_FILENO}));
    if (end.signal != 0 || end.exit_code > kMostFailures)
      throw IoError(fmt::format("parallel has failed: {}", shell_line("parallel", call)));
    failures += end.exit_code;
  }
  return failures;
}

}  // namespace springlod::sweep
