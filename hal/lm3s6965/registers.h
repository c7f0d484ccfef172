/* SPDX-License-Identifier: 0BSD */
/* The LM3S6965's registers, as far as they are used. Numbers are the data sheet's. */
#ifndef OW_HAL_LM3S6965_REGISTERS_H
#define OW_HAL_LM3S6965_REGISTERS_H

#include <stdint.h>

#define REG(address) (*(volatile uint32_t *)(uintptr_t)(address))

/* System control. */
#define SYSCTL_RIS REG(0x400FE050u)
#define SYSCTL_RCC REG(0x400FE060u)
#define SYSCTL_RCGC0 REG(0x400FE100u)
#define SYSCTL_RCGC1 REG(0x400FE104u)
#define SYSCTL_RCGC2 REG(0x400FE108u)
#define RIS_PLL_LOCKED (1u << 6)
#define RCC_BYPASS (1u << 11)
#define RCC_PLL_OFF (1u << 13)
#define RCC_USE_DIVISOR (1u << 22)
#define RCC_DIVISOR_SHIFT 23
#define RCC_OSCILLATOR_MASK 0x33u /* source, and which oscillators are off */
#define RCC_CRYSTAL_MASK (0xFu << 6)
#define RCC_CRYSTAL_8_MHZ (0xEu << 6)
#define RCGC0_WATCHDOG (1u << 3)
#define RCGC1_UART0 (1u << 0)
#define RCGC1_SSI0 (1u << 4)
#define RCGC2_PORT_A (1u << 0)
#define RCGC2_PORT_C (1u << 2)
#define RCGC2_PORT_D (1u << 3)
#define RCGC2_PORT_E (1u << 4)
#define RCGC2_PORT_F (1u << 5)

/* Ports. The address of DATA selects the pins that are read or written. */
#define PORT_A 0x40004000u
#define PORT_C 0x40006000u
#define PORT_D 0x40007000u
#define PORT_E 0x40024000u
#define PORT_F 0x40025000u
#define PORT_DATA(port, pins) REG((port) + ((uint32_t)(pins) << 2))
#define PORT_OUTPUT(port) REG((port) + 0x400u)
#define PORT_FUNCTION(port) REG((port) + 0x420u)
#define PORT_PULL_UP(port) REG((port) + 0x510u)
#define PORT_DIGITAL(port) REG((port) + 0x51Cu)

#define UART_0 0x4000C000u /* a PL011 */

/* Synchronous serial port 0 (PL022). */
#define SSI_CR0 REG(0x40008000u)
#define SSI_CR1 REG(0x40008004u)
#define SSI_DATA REG(0x40008008u)
#define SSI_STATUS REG(0x4000800Cu)
#define SSI_PRESCALE REG(0x40008010u)
#define SSI_STATUS_SEND_ROOM (1u << 1)
#define SSI_STATUS_RECEIVED (1u << 2)
#define SSI_STATUS_BUSY (1u << 4)
#define SSI_CR0_8_BITS 0x7u
#define SSI_CR0_MODE_3 (3u << 6) /* the clock idles high, data is taken at its second edge */
#define SSI_CR0_RATE_SHIFT 8
#define SSI_CR1_ON (1u << 1)

/* Watchdog. */
#define WATCHDOG_LOAD REG(0x40000000u)
#define WATCHDOG_VALUE REG(0x40000004u)
#define WATCHDOG_CONTROL REG(0x40000008u)
#define WATCHDOG_CLEAR REG(0x4000000Cu)
#define WATCHDOG_LOCK REG(0x40000C00u)
#define WATCHDOG_UNLOCK 0x1ACCE551u
#define WATCHDOG_COUNTS (1u << 0) /* and interrupts at zero; cannot be stopped again */
#define WATCHDOG_RESETS (1u << 1) /* at zero for the second time */

/* The Cortex-M3's own. */
#define SYSTICK_CONTROL REG(0xE000E010u)
#define SYSTICK_RELOAD REG(0xE000E014u)
#define SYSTICK_VALUE REG(0xE000E018u)
#define SYSTICK_ON 7u /* the processor's clock, with interrupt */
#define NVIC_ENABLE REG(0xE000E100u)
#define SCB_ICSR REG(0xE000ED04u)
#define ICSR_SYSTICK_PENDING (1u << 26)
#define SCB_RESET REG(0xE000ED0Cu)
#define SCB_RESET_NOW 0x05FA0004u
#define SCB_HANDLERS REG(0xE000ED24u)
#define SCB_FAULTS_APART (7u << 16) /* memory, bus and usage faults are not hard faults */
#define SCB_FAULT_STATUS REG(0xE000ED28u)
#define SCB_HARD_FAULT_STATUS REG(0xE000ED2Cu)
#define SCB_FAULT_ADDRESS REG(0xE000ED34u)
#define SCB_BUS_FAULT_ADDRESS REG(0xE000ED38u)
#define MPU_CONTROL REG(0xE000ED94u)
#define MPU_REGION REG(0xE000ED98u)
#define MPU_BASE REG(0xE000ED9Cu)
#define MPU_ATTRIBUTES REG(0xE000EDA0u)

enum { IRQ_UART0 = 5, IRQ_WATCHDOG = 18, IRQ_COUNT = 44 };

#endif
