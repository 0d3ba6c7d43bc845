// The command line of a program: options, flags and subcommands. It hides CLI11, which takes seconds to compile in each
// source that includes it.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace tern {

/// An option of a CommandLine, as a handle: copies are the same option. Each method returns the option, so calls chain:
/// `app.add_option("--jobs", jobs, "Number of jobs")->type_name("K")->range(1, 16)`.
class CommandOption {
 public:
  explicit CommandOption(CLI::Option* option) : option_(option) {}
  CommandOption* operator->() { return this; }

  CommandOption& type_name(const std::string& name);    ///< the name of the value in --help
  CommandOption& required();                            ///< the command line must have it
  CommandOption& capture_default_str();                 ///< --help prints the default
  CommandOption& envname(const std::string& variable);  ///< gives the value if the option is absent
  CommandOption& range(int low, int high);              ///< refuses values outside [low, high]
  CommandOption& range(double low, double high);
  CommandOption& non_negative();
  CommandOption& positive();
  CommandOption& one_of(const std::vector<std::string>& words);
  /// Refuses a value for which `why_not` returns a text: the reason.
  CommandOption& check(std::function<std::string(const std::string&)> why_not);
  CommandOption& excludes(const CommandOption& other);
  CommandOption& needs(const CommandOption& other);
  CommandOption& needs(const std::string& other);
  CommandOption& expected(int values);               ///< number of values
  CommandOption& allow_extra_args(bool are_values);  ///< true: further words are values of this option
  CommandOption& take_all();                         ///< keeps all values if the option is given several times
  CommandOption& set(const std::string& value);      ///< acts as if the command line gave this value

 private:
  CLI::Option* option_;
};

/// A command line, or one of its subcommands. Copies are the same command line. A subcommand is valid while a copy of
/// the whole command line exists. The variables of options must live until parse() has returned.
class CommandLine {
 public:
  explicit CommandLine(const std::string& description, const std::string& name = "");
  CommandLine* operator->() { return this; }

  /// @param names "--jobs", "-o,--out", or "LOG" for a positional argument
  /// @tparam T  one of the types instantiated in command_line.cpp: text, numbers, optional values, lists
  template <class T>
  CommandOption add_option(const std::string& names, T& value, const std::string& help);
  CommandOption add_flag(const std::string& name, bool& value, const std::string& help);
  CommandOption add_flag(const std::string& name, const std::function<void()>& given, const std::string& help);
  void set_version_flag(const std::string& name, const std::string& text);
  void take_last();  ///< for options added later: if one is given several times, its last value is used

  CommandLine add_subcommand(const std::string& name, const std::string& help);
  void prefix_command();  ///< all words after this program's own options belong to another program
  void require_subcommand(int least, int most);
  void callback(const std::function<void()>& run);        ///< called when this subcommand has been parsed
  void final_callback(const std::function<void()>& run);  ///< called when the whole command line has been parsed
  /// Whether this subcommand is given.
  explicit operator bool() const;
  /// The name of the first subcommand that is given, or "".
  [[nodiscard]] std::string chosen_subcommand() const;

  [[nodiscard]] CommandOption option(const std::string& name) const;
  [[nodiscard]] bool has(const std::string& name) const;  ///< whether this option is given
  [[nodiscard]] std::vector<std::string> given() const;   ///< the names of all options that are given
  /// Refuses an option; for use in a callback. parse() then prints "NAME: WHAT".
  [[noreturn]] static void refuse(const std::string& name, const std::string& what);

  /// Parses. Prints the help, the version or the refusal.
  /// @return the exit code if the program must end: 0 after help or version, `bad` after a refusal; else nullopt
  std::optional<int> parse(int argc, const char* const* argv, int bad);

 private:
  explicit CommandLine(std::shared_ptr<CLI::App> app) : app_(std::move(app)) {}
  std::shared_ptr<CLI::App> app_;
};

}  // namespace tern
