/* SPDX-License-Identifier: 0BSD */
/* The BCM2836's registers, as far as they are used, as its cores see them. */
#ifndef OW_HAL_BCM2836_REGISTERS_H
#define OW_HAL_BCM2836_REGISTERS_H

#include <stdint.h>

#define REG(address) (*(volatile uint32_t *)(uintptr_t)(address))

#define PERIPHERALS 0x3F000000u

#define TIMER_STATUS REG(PERIPHERALS + 0x3000)
#define TIMER_LOW REG(PERIPHERALS + 0x3004)
#define TIMER_HIGH REG(PERIPHERALS + 0x3008)
#define TIMER_ALARM_1 REG(PERIPHERALS + 0x3010)
#define TIMER_BIT_1 (1u << 1)

#define IRQ_ENABLE_1 REG(PERIPHERALS + 0xB210)
#define IRQ_ENABLE_2 REG(PERIPHERALS + 0xB214)
#define IRQ_1_TIMER_1 (1u << 1)
#define IRQ_2_UART (1u << 25)

#define MAILBOX_READ REG(PERIPHERALS + 0xB880)
#define MAILBOX_STATUS REG(PERIPHERALS + 0xB898)
#define MAILBOX_WRITE REG(PERIPHERALS + 0xB8A0)
#define MAILBOX_FULL (1u << 31)
#define MAILBOX_EMPTY (1u << 30)
#define MAILBOX_PROPERTIES 8u
#define MAILBOX_UNCACHED 0xC0000000u /* the firmware's name for memory past its cache */

#define POWER_RESET REG(PERIPHERALS + 0x10001C)
#define POWER_TIME REG(PERIPHERALS + 0x100024)
#define POWER_PASSWORD 0x5A000000u
#define POWER_RESET_MASK 0x30u
#define POWER_RESET_FULL 0x20u

#define UART_0 (PERIPHERALS + 0x201000) /* a PL011 */

#define PINS_10_19 REG(PERIPHERALS + 0x200004)
#define PINS_UART_MASK (077u << 12) /* pins 14 and 15 */
#define PINS_UART (044u << 12)      /* their first alternative */

/* Of each core. */
#define CORE_MAILBOX_IRQS(core) REG(0x40000050u + 4 * (core))
#define CORE_MAILBOX_SET(core, box) REG(0x40000080u + 16 * (core) + 4 * (box))
#define CORE_MAILBOX_CLEAR(core, box) REG(0x400000C0u + 16 * (core) + 4 * (box))
enum { BOX_WORK = 0, BOX_START = 3 };

#endif
