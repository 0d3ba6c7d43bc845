#include "planner/optimization/ipopt_solver.h"

#include <dlfcn.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <stdexcept>
#include <vector>

#include "planner/optimization/nlp_plugin.h"

namespace tern {
namespace {

constexpr char kFile[] = "tern-ipopt.so";

struct Plugin {
  TernNlpMinimise* minimise = nullptr;
  std::string why_not;
};

/// Folders that may hold the plug-in: beside this code, and those of an installation.
std::vector<std::filesystem::path> folders() {
  std::vector<std::filesystem::path> beside;
  std::error_code unreadable;
  const auto program = std::filesystem::read_symlink("/proc/self/exe", unreadable);
  if (!unreadable) beside.push_back(program.parent_path());
  Dl_info here{};
  if (dladdr(reinterpret_cast<const void*>(&why_no_ipopt), &here) != 0 && here.dli_fname != nullptr) {
    const auto object = std::filesystem::weakly_canonical(here.dli_fname, unreadable);
    // A program that was found by PATH has its bare name here.
    if (!unreadable && object.is_absolute() && object.parent_path() != program.parent_path()) {
      beside.push_back(object.parent_path());
    }
  }
  std::vector<std::filesystem::path> found = beside;
  for (const auto& folder : beside) found.push_back(folder.parent_path() / TERN_LIBRARY_FOLDER / "tern");
  found.emplace_back(std::filesystem::path(TERN_FULL_LIBRARY_FOLDER) / "tern");
  return found;
}

Plugin load() {
  std::vector<std::string> looked;
  for (const auto& folder : folders()) {
    const std::filesystem::path file = folder / kFile;
    std::error_code unreadable;
    if (!std::filesystem::exists(file, unreadable)) {
      looked.push_back(folder.string());
      continue;
    }
    void* object = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);  // never closed: it is used until the process ends
    if (object == nullptr) return {nullptr, fmt::format("Ipopt cannot be loaded: {}", dlerror())};
    auto* minimise = reinterpret_cast<TernNlpMinimise*>(dlsym(object, kTernNlpMinimise));
    if (minimise == nullptr)
      return {nullptr, fmt::format("{} is of another version of Tern: it has no {}", file.string(), kTernNlpMinimise)};
    return {minimise, ""};
  }
  return {nullptr, fmt::format("{} is not installed (Debian: tern-ipopt; in the tree: launch_scripts/build.sh "
                               "tern-ipopt). It was looked for in {}",
                               kFile, fmt::join(looked, ", "))};
}

const Plugin& plugin() {
  static const Plugin loaded = load();
  return loaded;
}

/// A problem as the plug-in's functions see it.
struct Task {
  const NonlinearProblem& problem;
  const StopFunction& stop;
  const Visit& visit;

  [[nodiscard]] Eigen::VectorXd view(const double* x) const {
    return Eigen::Map<const Eigen::VectorXd>(x, problem.variables());
  }
};

const Task& task_of(void* problem) { return *static_cast<const Task*>(problem); }

double objective(void* problem, const double* x) {
  const Task& task = task_of(problem);
  return task.problem.objective(task.view(x));
}

void gradient(void* problem, const double* x, double* gradient) {
  const Task& task = task_of(problem);
  Eigen::Map<Eigen::VectorXd>(gradient, task.problem.variables()) = task.problem.gradient(task.view(x));
}

void constraint_values(void* problem, const double* x, double* c) {
  const Task& task = task_of(problem);
  const Eigen::VectorXd at = task.view(x);
  const Eigen::VectorXd constraints = task.problem.constraints(at);
  std::copy_n(constraints.data(), constraints.size(), c);
  task.visit(at, constraints);
}

void jacobian(void* problem, const double* x, double* entries) {
  const Task& task = task_of(problem);
  task.problem.jacobian(task.view(x), entries);
}

void hessian(void* problem, const double* x, double factor, const double* multipliers, double* entries) {
  const Task& task = task_of(problem);
  task.problem.hessian(task.view(x), factor, multipliers, entries);
}

int stops(void* problem) { return task_of(problem).stop() ? 1 : 0; }

}  // namespace

const std::string& why_no_ipopt() { return plugin().why_not; }

IpoptRun minimise_by_ipopt(const NonlinearProblem& problem, const Eigen::VectorXd& x0, int max_iterations,
                           const StopFunction& stop, const Visit& visit) {
  if (plugin().minimise == nullptr) throw std::runtime_error(why_no_ipopt());
  visit(x0, problem.constraints(x0));
  Task task{problem, stop, visit};
  const SparsePattern &j = problem.jacobian_pattern(), &h = problem.hessian_pattern();
  const TernNlp nlp{.problem = &task,
                    .variables = problem.variables(),
                    .constraints = static_cast<int>(problem.bounds().size()),
                    .jacobian_entries = static_cast<int>(j.size()),
                    .hessian_entries = static_cast<int>(h.size()),
                    .jacobian_rows = j.rows.data(),
                    .jacobian_columns = j.columns.data(),
                    .hessian_rows = h.rows.data(),
                    .hessian_columns = h.columns.data(),
                    .start = x0.data(),
                    .bounds = problem.bounds().data(),
                    .objective = objective,
                    .gradient = gradient,
                    .constraint_values = constraint_values,
                    .jacobian = jacobian,
                    .hessian = hessian,
                    .stop = stops};
  const TernNlpRun run = plugin().minimise(&nlp, max_iterations);
  return {run.failed != 0, run.iterations};
}

ConvexSolution solve_by_ipopt(const ConvexProblem& problem, const FreeVariables& x0, int max_iterations,
                              const StopFunction& stop) {
  ConvexSolution best;
  const auto keep_if_best = [&](const Eigen::VectorXd& x, const Eigen::VectorXd&) {
    if (!(problem.worst_violation(x) <= 0.0)) return;
    const double objective = problem.objective(x);
    if (best.found && objective >= best.objective) return;
    best.found = true;
    best.x = x;
    best.objective = objective;
  };
  const IpoptRun run = minimise_by_ipopt(ConvexAsNonlinear(problem), x0, max_iterations, stop, keep_if_best);
  best.solver_failed = run.failed;
  best.iterations = run.iterations;
  return best;
}

}  // namespace tern
