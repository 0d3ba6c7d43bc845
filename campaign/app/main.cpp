// tern-campaign: many seeded flights on virtual time, each in a process of its own.
#include <fmt/format.h>

#include <cstdio>
#include <exception>
#include <system_error>

#include "campaign/app/commands.h"
#include "runtime/command_line.h"
#include "runtime/config.h"
#include "runtime/process.h"
#include "runtime/version.h"

int main(int argc, char** argv) {
  tern::CommandLine app{
      "Flies a scenario with many seeds on virtual time. Writes a row of CSV per flight, and a summary."};
  app.set_version_flag("--version", std::string("tern-campaign ") + tern::build_id());
  tern::Command chosen;
  tern::add_campaign(app, chosen);
  tern::add_check(app, chosen);
  tern::add_fly_one(app, chosen);
  tern::add_judge_contacts(app, chosen);
  tern::add_merge(app, chosen);
  tern::add_schema(app, chosen);
  tern::add_summarize(app, chosen);
  tern::add_ways(app, chosen);
  tern::add_compare(app, chosen);
  tern::add_paper(app, chosen);
  try {
    if (const auto code = app.parse(argc, argv, tern::kExitBadConfiguration)) return *code;
    const int result = chosen();
    if (result != 0 || (std::fflush(stdout) == 0 && std::ferror(stdout) == 0)) return result;
    throw tern::FileError("standard output: cannot be written");
  } catch (const tern::ConfigError& error) {
    fmt::print(stderr, "{}\n", error.what());
    return tern::kExitBadConfiguration;
  } catch (const tern::FileError& error) {
    fmt::print(stderr, "{}\n", error.what());
    return tern::kExitFile;
  } catch (const std::system_error& error) {  // of std::filesystem, or of fmt for standard output
    fmt::print(stderr, "tern-campaign: {}\n", error.what());
    return tern::kExitFile;
  } catch (const std::exception& error) {
    fmt::print(stderr, "tern-campaign: {}\n", error.what());
    return tern::kExitStuck;
  }
}
