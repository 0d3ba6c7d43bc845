#include "runtime/command_line.h"

#include <CLI/CLI.hpp>
#include <cstdint>
#include <utility>

namespace tern {

CommandOption& CommandOption::type_name(const std::string& name) {
  option_->type_name(name);
  return *this;
}

CommandOption& CommandOption::required() {
  option_->required();
  return *this;
}

CommandOption& CommandOption::capture_default_str() {
  option_->capture_default_str();
  return *this;
}

CommandOption& CommandOption::envname(const std::string& variable) {
  option_->envname(variable);
  return *this;
}

CommandOption& CommandOption::range(int low, int high) {
  option_->check(CLI::Range(low, high));
  return *this;
}

CommandOption& CommandOption::range(double low, double high) {
  option_->check(CLI::Range(low, high));
  return *this;
}

CommandOption& CommandOption::non_negative() {
  option_->check(CLI::NonNegativeNumber);
  return *this;
}

CommandOption& CommandOption::positive() {
  option_->check(CLI::PositiveNumber);
  return *this;
}

CommandOption& CommandOption::one_of(const std::vector<std::string>& words) {
  option_->check(CLI::IsMember(words));
  return *this;
}

CommandOption& CommandOption::check(std::function<std::string(const std::string&)> why_not) {
  option_->check(std::move(why_not));
  return *this;
}

CommandOption& CommandOption::excludes(const CommandOption& other) {
  option_->excludes(other.option_);
  return *this;
}

CommandOption& CommandOption::needs(const CommandOption& other) {
  option_->needs(other.option_);
  return *this;
}

CommandOption& CommandOption::needs(const std::string& other) {
  option_->needs<CLI::App>(other);
  return *this;
}

CommandOption& CommandOption::expected(int values) {
  option_->expected(values);
  return *this;
}

CommandOption& CommandOption::allow_extra_args(bool are_values) {
  option_->allow_extra_args(are_values);
  return *this;
}

CommandOption& CommandOption::take_all() {
  option_->take_all();
  return *this;
}

CommandOption& CommandOption::set(const std::string& value) {
  option_->add_result(value);
  option_->run_callback();
  return *this;
}

CommandLine::CommandLine(const std::string& description, const std::string& name)
    : app_(std::make_shared<CLI::App>(description, name)) {}

template <class T>
CommandOption CommandLine::add_option(const std::string& names, T& value, const std::string& help) {
  return CommandOption(app_->add_option(names, value, help));
}

template CommandOption CommandLine::add_option(const std::string&, std::string&, const std::string&);
template CommandOption CommandLine::add_option(const std::string&, int&, const std::string&);
template CommandOption CommandLine::add_option(const std::string&, std::int64_t&, const std::string&);
template CommandOption CommandLine::add_option(const std::string&, std::uint64_t&, const std::string&);
template CommandOption CommandLine::add_option(const std::string&, double&, const std::string&);
template CommandOption CommandLine::add_option(const std::string&, std::optional<std::string>&, const std::string&);
template CommandOption CommandLine::add_option(const std::string&, std::optional<int>&, const std::string&);
template CommandOption CommandLine::add_option(const std::string&, std::optional<std::int64_t>&, const std::string&);
template CommandOption CommandLine::add_option(const std::string&, std::optional<double>&, const std::string&);
template CommandOption CommandLine::add_option(const std::string&, std::vector<int>&, const std::string&);
template CommandOption CommandLine::add_option(const std::string&, std::vector<double>&, const std::string&);
template CommandOption CommandLine::add_option(const std::string&, std::optional<std::uint64_t>&, const std::string&);
template CommandOption CommandLine::add_option(const std::string&, std::vector<std::string>&, const std::string&);

CommandOption CommandLine::add_flag(const std::string& name, bool& value, const std::string& help) {
  return CommandOption(app_->add_flag(name, value, help));
}

CommandOption CommandLine::add_flag(const std::string& name, const std::function<void()>& given,
                                    const std::string& help) {
  return CommandOption(app_->add_flag(
      name, [given](std::int64_t) { given(); }, help));
}

void CommandLine::set_version_flag(const std::string& name, const std::string& text) {
  app_->set_version_flag(name, text);
}

void CommandLine::take_last() { app_->option_defaults()->take_last(); }

// The whole owns its subcommands.
CommandLine CommandLine::add_subcommand(const std::string& name, const std::string& help) {
  return CommandLine(std::shared_ptr<CLI::App>(app_, app_->add_subcommand(name, help)));
}

void CommandLine::prefix_command() { app_->prefix_command(); }

void CommandLine::require_subcommand(int least, int most) {
  app_->require_subcommand(static_cast<std::size_t>(least), static_cast<std::size_t>(most));
}

void CommandLine::callback(const std::function<void()>& run) { app_->callback(run); }

void CommandLine::final_callback(const std::function<void()>& run) { app_->final_callback(run); }

CommandLine::operator bool() const { return static_cast<bool>(*app_); }

std::string CommandLine::chosen_subcommand() const {
  const std::vector<CLI::App*> chosen = app_->get_subcommands();
  return chosen.empty() ? "" : chosen.front()->get_name();
}

CommandOption CommandLine::option(const std::string& name) const { return CommandOption(app_->get_option(name)); }

bool CommandLine::has(const std::string& name) const { return app_->get_option(name)->count() > 0; }

std::vector<std::string> CommandLine::given() const {
  std::vector<std::string> names;
  for (const CLI::Option* option : std::as_const(*app_).get_options()) {
    if (option->count() > 0) names.push_back(option->get_name());
  }
  return names;
}

void CommandLine::refuse(const std::string& name, const std::string& what) { throw CLI::ValidationError(name, what); }

std::optional<int> CommandLine::parse(int argc, const char* const* argv, int bad) {
  try {
    app_->parse(argc, argv);
    return std::nullopt;
  } catch (const CLI::ParseError& error) {
    return app_->exit(error) == 0 ? 0 : bad;
  }
}

}  // namespace tern
