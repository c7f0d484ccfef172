#!/bin/bash
# SPDX-License-Identifier: 0BSD
# oldwell on SPI panels: spidev, libgpiod in both interfaces, controllers at the guest's pins.
exec "$(dirname "$0")/lib/run" spi
