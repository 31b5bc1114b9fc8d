#pragma once

#include <cstdint>
#include <string>

#include "base/error.h"
#include "cli/command_line.h"
#include "cli/console.h"

/// One function per verb. Each returns the exit status, prints data to stdout and talks through the console;
/// what it throws ends the command (message and status in run.cpp).
namespace skinforge {

ExitCode build_command(const CommandLine& line, Console& console);
ExitCode check_command(const CommandLine& line, Console& console);
ExitCode plan_command(const CommandLine& line, Console& console);
ExitCode explain_command(const CommandLine& line, Console& console);
ExitCode expand_command(const CommandLine& line, Console& console);
ExitCode migrate_command(const CommandLine& line, Console& console);
ExitCode report_command(const CommandLine& line, Console& console);
ExitCode inspect_command(const CommandLine& line, Console& console);
ExitCode diff_command(const CommandLine& line, Console& console);
ExitCode verify_command(const CommandLine& line, Console& console);
ExitCode validate_command(const CommandLine& line, Console& console);
ExitCode repair_command(const CommandLine& line, Console& console);
ExitCode graph_command(const CommandLine& line, Console& console);
ExitCode doctor_command(const CommandLine& line, Console& console);
ExitCode bind_command(const CommandLine& line, Console& console);
ExitCode deform_command(const CommandLine& line, Console& console);
ExitCode compare_skinning_command(const CommandLine& line, Console& console);
ExitCode stage_run_command(const CommandLine& line, Console& console);
ExitCode stage_list_command(const CommandLine& line, Console& console);
ExitCode cache_stats_command(const CommandLine& line, Console& console);
ExitCode cache_gc_command(const CommandLine& line, Console& console);
ExitCode cache_pin_command(const CommandLine& line, Console& console);
ExitCode cache_unpin_command(const CommandLine& line, Console& console);
ExitCode cache_verify_command(const CommandLine& line, Console& console);
ExitCode cache_clear_command(const CommandLine& line, Console& console);
ExitCode cache_path_command(const CommandLine& line, Console& console);
ExitCode schema_command(const CommandLine& line, Console& console);
ExitCode version_command(const CommandLine& line, Console& console);

/// "682 kB", "1.4 MB": decimal, as file managers count.
std::string readable_size(std::uint64_t bytes);

}  // namespace skinforge
