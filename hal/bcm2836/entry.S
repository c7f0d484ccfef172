/* SPDX-License-Identifier: 0BSD */
/*
 * From reset to C: the mode, a stack for each core, the vector table. Cores 1 to
 * 3 come here at once in an emulator, or when core 0 calls them through their
 * mailboxes on the board.
 */
    .arch armv7-a
    .arch_extension virt
    .arch_extension sec
    .syntax unified
    .arm

    .section .start, "ax"
    .global chip_entry
chip_entry:
    cpsid   if
    mrs     r0, cpsr
    and     r1, r0, #0x1F
    cmp     r1, #0x1A               /* the board's firmware hands over in hypervisor mode */
    bne     1f
    bic     r0, r0, #0x1F
    orr     r0, r0, #0xD3
    msr     spsr_cxsf, r0
    adr     r0, 1f
    msr     elr_hyp, r0
    eret
1:  cps     #0x13                   /* supervisor */
    mrc     p15, 0, r4, c0, c0, 5   /* which core */
    and     r4, r4, #3
    ldr     r0, =ld_stacks_end
    ldr     r1, =STACK_BYTES
    mul     r2, r1, r4
    sub     r0, r0, r2
    cps     #0x12                   /* interrupts and faults: the top KB of the core's stack */
    mov     sp, r0
    cps     #0x17
    mov     sp, r0
    cps     #0x1B
    mov     sp, r0
    cps     #0x13
    sub     sp, r0, #1024
    ldr     r0, =vectors
    mcr     p15, 0, r0, c12, c0, 0
    cmp     r4, #0
    bne     other

    ldr     r0, =ld_stacks_begin    /* painted, so that the high-water mark can be seen */
    mov     r1, sp
    ldr     r2, =0xA5A5A5A5
2:  cmp     r0, r1
    strlo   r2, [r0], #4
    blo     2b
    ldr     r0, =ld_bss_begin
    ldr     r1, =ld_bss_end
    mov     r2, #0
3:  cmp     r0, r1
    strlo   r2, [r0], #4
    blo     3b
    bl      chip_main

other:
    ldr     r0, =chip_others_go     /* not before core 0 has cleared memory and made the tables */
    ldr     r2, =0x600D600D
4:  ldr     r1, [r0]
    cmp     r1, r2
    beq     5f
    wfe
    b       4b
5:  mov     r0, r4
    bl      chip_other_main

    .balign 32
vectors:
    b       chip_entry
    b       undefined
    b       called
    b       fetch
    b       data
    b       chip_entry
    b       interrupt
    b       chip_entry

undefined:
    mov     r0, #0
    b       fault
called:
    mov     r0, #1
    b       fault
fetch:
    mov     r0, #2
    b       fault
data:
    mov     r0, #3
fault:
    mov     r1, lr
    mrs     r2, spsr
    b       chip_fault

interrupt:
    sub     lr, lr, #4
    push    {r0-r3, r12, lr}
    bl      chip_irq
    ldm     sp!, {r0-r3, r12, pc}^
