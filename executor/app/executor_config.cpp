#include "executor/app/executor_config.h"

namespace tern {

ExecutorConfig read_executor_config(ConfigSection section) {
  ExecutorConfig config;
  section.read(config);
  return config;
}

}  // namespace tern
