// SPDX-License-Identifier: MIT
import { section } from "./dom.js";

export function makeLesson() {
    return { box: section("Lesson", false) };
}
