// SPDX-License-Identifier: Apache-2.0

// The invsim command.

#include "command.h"
#include "dispatcher.h"

int main(int argc, char** argv) {
  return invsim::Dispatch(invsim::AllCommands(), argc, argv);
}
