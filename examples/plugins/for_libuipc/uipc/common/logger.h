// SPDX-License-Identifier: MIT
//
// Stands before libuipc's header of this name: see log.h beside it.
#pragma once

#include <uipc/common/log.h>
