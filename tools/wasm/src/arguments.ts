// SPDX-License-Identifier: MIT
//
// Arguments that the library would not see as they were given: WebAssembly takes -1 for 4294967295, and NaN for 0.
import { Field, Status } from "./layout.js";

export type Numbers = ArrayLike<number>;
export type FieldNumber = (typeof Field)[keyof typeof Field];

/** A failed call: its status, one of Status, and one line of text, which is the library's own where that refused. */
export class SwivelError extends Error {
    constructor(readonly status: number, text: string) {
        super(text);
        this.name = "SwivelError";
    }
}

export function refuse(text: string): never {
    throw new SwivelError(Status.INVALID_ARGUMENT, text);
}

/** A value as a message shows it. */
export function shown(value: unknown): string {
    return typeof value === "string" ? JSON.stringify(value) : String(value);
}

/** A count or an index. */
export function whole(name: string, number: number, max = 0xffffffff): number {
    if (!Number.isInteger(number) || number < 0 || number > max) refuse(`${name} is ${shown(number)}; give a whole number from 0 to ${max}`);
    return number;
}

/** One number. */
export function real(name: string, number: number): number {
    if (typeof number !== "number") refuse(`${name} is ${shown(number)}; give a number`);
    return number;
}

/** An array of numbers, of the given length if there is one. */
export function numbers(name: string, values: Numbers, count = values?.length): Numbers {
    if (typeof values !== "object" || typeof values?.length !== "number") refuse(`${name} is ${shown(values)}; give an array of numbers`);
    if (values.length !== count) refuse(`${name} has ${values.length} numbers; give ${count}`);
    return values;
}

/** An object of options: a name that does not exist is a mistake, not a wish to ignore. */
export function options<Options extends object>(of: string, given: Options, ...names: (keyof Options & string)[]): Options {
    if (typeof given !== "object" || given === null || Array.isArray(given)) refuse(`${of} takes ${names.join(", ")}, not ${shown(given)}`);
    for (const name of Object.keys(given))
        if (!names.includes(name as keyof Options & string)) refuse(`${of} takes ${names.join(", ")}, not ${name}`);
    return given;
}

const names = new Map<FieldNumber, string>(Object.entries(Field).map(([name, field]) => [field, name]));
export function nameOf(field: FieldNumber): string {
    return names.get(field) ?? refuse(`the field is ${shown(field)}; give one of Field`);
}
