// The section `executor:` of a scenario file (executor/README.md lists the keys).
#pragma once

#include "executor/executor.h"
#include "runtime/config.h"

namespace tern {

/// Reads and finishes the section. @throws ConfigError.
ExecutorConfig read_executor_config(ConfigSection section);

}  // namespace tern
