// Runs a hosted node on the wall clock.
#pragma once

#include "runtime/multicast_sockets.h"
#include "runtime/process.h"

namespace tern {

/// Waits for messages, the node's next wakeup or a signal, and steps the node.
/// @param stop_fd  readable when the process is to end (a signalfd, a pipe); Node::end() is asked; −1: none
/// @param sockets  of `lcm`, kept usable when interfaces and routes change; null: none
/// @return the node's exit code when it has finished; 0 when stop_fd became readable and the node ends.
/// @throws the exception of a handler or the node; std::runtime_error if polling or LCM fails.
int run_on_wall_clock(lcm::LCM& lcm, NodeHost& host, int stop_fd, MulticastSockets* sockets = nullptr);

}  // namespace tern
