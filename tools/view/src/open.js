// SPDX-License-Identifier: MIT
//
// From the data that `swivel view` writes to a stage: whether command and page fit each other, and how much memory to take.
import { instantiate } from "swivel-wasm/instantiate.js";
import { layout, VERSION } from "swivel-wasm/layout.js";
import wasm from "view.wasm";

import { byteCountOf, sizeOf } from "./bytes.js";
import { askedOf, Stage } from "./stage.js";

const MAX_MEGABYTES = 4096;  // that WebAssembly can address

/** Frames of the clip, by the positions of its joints. The crowd may have been solved for fewer. */
const clipFramesOf = (data) => byteCountOf(data.positions) / (12 * data.joints.length);

/** Refuses data of a command whose structures are laid out in another way. */
function check(data) {
    const again = "Make both of one source: tools/view/build makes the page's program";
    if (data.version !== VERSION) throw new Error(`the command is swivel ${data.version}, and the page's program is swivel ${VERSION}. ${again}`);
    const expect = (name, base64, bytes) => {
        const given = byteCountOf(base64);
        if (given !== bytes) throw new Error(`the command wrote ${given} bytes for ${name}, and the page's program expects ${bytes}. ${again}`);
    };
    expect("characters", data.characters, sizeOf("goal_character") * data.character_count);
    if (data.ground) expect("the ground", data.ground.grid, sizeOf("goal_ground"));
    for (const { name, plan, sources, plant, ground } of askedOf(data)) {
        expect(`the plan of ${name}`, plan, sizeOf("goal_plan"));
        expect(`the clip of ${name}`, sources, sizeOf("goal_source") * clipFramesOf(data));
        if (!ground) continue;
        expect(`the plant of ${name}`, plant, layout.swivel_plant.bytes);
        expect(`the ground of ${name}`, ground, layout.swivel_ground.bytes);
    }
}

/** What the module's memory must hold: the clip, and for each limb what goes in, what comes out, and a crowd made anew beside the old. */
function megabytesFor(data) {
    const start = byteCountOf(data.characters) + byteCountOf(data.ground?.heights ?? "");
    const clip = askedOf(data).reduce((sum, { sources }) => sum + byteCountOf(sources), start);
    const limbs = askedOf(data).length * data.character_count * (2048 + sizeOf("goal_input"));
    const megabytes = 48 + Math.ceil((clip + limbs) / 2 ** 20);
    if (megabytes > MAX_MEGABYTES)
        throw new Error(`this crowd takes ${megabytes} MB of memory, and a page can have ${MAX_MEGABYTES}. Take fewer --frames or --characters`);
    return megabytes;
}

/** Opens a stage for the page's data. */
export async function openStage(data) {
    check(data);
    return new Stage(await instantiate({ wasm, megabytes: megabytesFor(data) }), data);
}
