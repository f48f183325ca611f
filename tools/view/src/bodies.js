// SPDX-License-Identifier: MIT
//
// The crowd's bodies: capsules, an instance for each character. Bodies follow the clip. Limbs follow the solver:
// their vertices find elbow and wrist from its rows.
import { layout } from "swivel-wasm/layout.js";
import {
    CapsuleGeometry, Float32BufferAttribute, InstancedBufferGeometry, Mesh, Quaternion, Vector3, Vector4,
} from "three";

import bodyFragment from "./body.frag.glsl";
import bodyVertex from "./body.vert.glsl";
import { Boxes } from "./boxes.js";
import capsule from "./capsule.glsl";
import { CHOSEN, flagColours, flagMasks, LIMB_COLOURS, rampColours, rgb } from "./colours.js";
import limbFragment from "./limb.frag.glsl";
import limbGlsl from "./limb.glsl";
import limbVertex from "./limb.vert.glsl";
import { floatTexture, LimbRows } from "./rows.js";
import { withShadow } from "./shaded.js";
import { MAX_SKINS, Skins } from "./skins.js";

export const SKIN = -1;  // in place of limbs' colours
const SUN = new Vector3(0.45, 1, 0.35);

/**
 * The capsules of one character, each with its axis along z: directions from the axis, which end they belong to, and the part that the
 * capsule is. A shadow needs few of them.
 */
function capsules(partCount, isShadow) {
    const one = new CapsuleGeometry(1, 1, isShadow ? 1 : 3, isShadow ? 7 : 10).rotateX(Math.PI / 2), { position } = one.attributes;
    const directions = [], ends = [], parts = [], indices = [];
    for (let part = 0; part < partCount; ++part) {
        for (const n of one.index.array) indices.push(part * position.count + n);
        for (let n = 0; n < position.count; ++n) {
            const end = position.getZ(n) > 0 ? 1 : 0;
            directions.push(position.getX(n), position.getY(n), position.getZ(n) - (end ? 0.5 : -0.5));
            ends.push(end);
            parts.push(part);
        }
    }
    const geometry = new InstancedBufferGeometry();
    geometry.setIndex(indices);
    geometry.setAttribute("position", new Float32BufferAttribute(directions, 3));
    geometry.setAttribute("end", new Float32BufferAttribute(ends, 1));
    geometry.setAttribute("part", new Float32BufferAttribute(parts, 1));
    return geometry;
}

/** The wrist joint's rotation relative to the hand as results have it, which has the arm frame's axes at rest. */
function handFromArm({ swivel, skeleton }, { chain }) {
    const { buffer } = swivel.bindJoints(skeleton, chain).bytes;
    const rotation = (member) => new Quaternion().fromArray(new Float32Array(buffer, layout.swivel_binding[member], 4));
    return rotation("wrist_parent_from_arm").invert().multiply(rotation("wrist_rest"));
}

export class Bodies {
    /** scale: metres of the scene for a unit of the clip. maxTexels: of a side of a texture. ground: its uniforms. */
    constructor(stage, figure, scale, maxTexels, ground) {
        this.stage = stage;
        this.figure = figure;
        this.maxTexels = maxTexels;
        this.meshes = [];
        this.drawnCount = 1;  // until show() says it
        this.extra = null;  // the character that is drawn beside the first ones, or null
        const { characters, limbs: [{ sources }] } = stage, { jointCount, frameCount } = figure;
        const positions = new Float32Array(figure.positions.length / 3 * 4);
        for (let n = 0; n < figure.positions.length / 3; ++n) positions.set(figure.positions.subarray(3 * n, 3 * n + 3), 4 * n);
        this.shared = {
            uCharacters: floatTexture("the characters", characters.flatMap(({ size, place, start, first, count, heading }) => [...place, size, start, first, count, heading]), maxTexels),
            uPositions: floatTexture("the clip's positions", positions, maxTexels),
            uRoots: floatTexture("the clip's roots", Array.from({ length: frameCount }, (_, n) => [...sources.root(n), 0]).flat(), maxTexels),
            uFrame: 0, uJointCount: jointCount,
            uDrawn: 1, uExtra: 0, uScale: scale, uGround: figure.ground, uSun: SUN, uFar: 60,
            uSky: rgb("#ffffff"), uEarth: rgb("#888888"), uBackground: rgb("#ffffff"), uShade: rgb("#cccccc"),
        };
        this.shared.uRises = floatTexture("the characters' heights", new Float32Array(4 * characters.length), maxTexels);
        for (const name of Object.keys(this.shared)) this.shared[name] = { value: this.shared[name] };
        Object.assign(this.shared, ground);
        this.addBody();
        this.limbs = stage.limbs.map((limb) => this.addLimb(limb));
        this.capsules = this.meshes.slice();
        this.boxes = stage.data.box ? new Boxes(stage, stage.data.box, this.shared) : null;
        if (this.boxes) this.meshes.push(...this.boxes.meshes);
        this.skins = null;
        this.colouredBy = 0;
    }
    /** Draws the figure's own skin from now on, as long as limbs have no colours. Arguments: as Skins has them. */
    addSkin(skin, made) {
        this.skins = new Skins(this.stage, this.figure, skin, made, this.shared, this.maxTexels);
        this.meshes.push(...this.skins.meshes);
        this.colouredBy = SKIN;
    }

    addBody() {
        const bones = this.figure.bodyBones();
        const texels = floatTexture("the bones", bones.flatMap(({ a, b, radiusA, radiusB }) => [a, b, radiusA, radiusB]), this.maxTexels);
        this.bodyColour = { value: rgb("#888888") };
        const uniforms = { uBones: { value: texels }, uColour: this.bodyColour };
        this.add(bones.length, uniforms, [capsule, bodyVertex], bodyFragment);
    }
    addLimb(limb) {
        const { radii, tip } = this.figure.limbShape(limb);
        const uniforms = {
            uHandFromArm: handFromArm(this.stage, limb), uTip: tip,
            uRadii: new Vector4(1.05 * radii[0], 0.85 * radii[0], 0.8 * radii[1], 0.75 * radii[2]), uChosen: -1,
            uColour: rgb(LIMB_COLOURS[limb.index % LIMB_COLOURS.length]), uChosenColour: rgb(CHOSEN), uColourBy: 0,
            uRamp: rampColours(), uFlagColours: flagColours(), uFlagMasks: flagMasks(),
        };
        for (const name of Object.keys(uniforms)) uniforms[name] = { value: uniforms[name] };
        const drawn = { limb, uniforms, rows: null, crowd: null };
        this.takeRows(drawn);
        this.add(3, uniforms, [limbGlsl, capsule, limbVertex], limbFragment);
        return drawn;
    }
    /** The rows of those that are drawn. The crowd is made again when features change. */
    takeRows(drawn) {
        const { crowd } = this.stage, blocks = Math.ceil(this.drawnCount / 16);
        const extra = this.extra === null ? null : Math.floor(this.extra / 16);
        if (drawn.crowd === crowd && drawn.rows.blocks === blocks && drawn.rows.extra === extra) return drawn.rows.update();
        drawn.rows?.dispose();
        drawn.crowd = crowd;
        drawn.rows = new LimbRows(crowd, drawn.limb, blocks, extra, this.maxTexels);
        for (const [name, value] of Object.entries(drawn.rows.uniforms)) {
            drawn.uniforms[name] ??= { value };
            drawn.uniforms[name].value = value;
        }
    }
    add(partCount, own, vertex, fragment) {
        const uniforms = { ...this.shared, ...own }, defines = { FLAG_COLOURS: flagMasks().length };
        this.meshes.push(...withShadow({ uniforms, defines, vertex, fragment }, (material, isShadow) => new Mesh(capsules(partCount, isShadow), material)));
    }

    /** Draws the first characters and perhaps one more, as the stage has them now. */
    show(drawnCount, wanted) {
        this.drawnCount = this.shared.uDrawn.value = drawnCount;
        this.extra = wanted >= drawnCount ? wanted : null;
        this.shared.uExtra.value = this.extra ?? 0;
        this.shared.uFrame.value = this.stage.frame;
        this.takeRises();
        for (const drawn of this.limbs) this.takeRows(drawn);
        for (const mesh of this.capsules) mesh.geometry.instanceCount = drawnCount + (this.extra === null ? 0 : 1);
        this.isInSkins = this.colouredBy === SKIN && drawnCount <= MAX_SKINS;
        this.isPosed = false;
        for (const mesh of this.capsules) mesh.visible = !this.isInSkins;
        for (const mesh of this.skins?.meshes ?? []) mesh.visible = this.isInSkins;
        this.boxes?.show(drawnCount, this.extra);
    }
    /** Before a picture: poses skins, once after all that has been shown. */
    pose() {
        if (this.isInSkins && !this.isPosed) this.skins.show(this.drawnCount, this.extra);
        this.isPosed = true;
    }
    takeRises() {
        const { rises } = this.stage, texture = this.shared.uRises.value;
        if (!rises) return;
        texture.image.data.set(rises);
        texture.needsUpdate = true;
    }
    choose(limb, character) {
        for (const drawn of this.limbs) drawn.uniforms.uChosen.value = drawn.limb === limb ? character : -1;
        this.skins?.choose(limb, character);
    }
    /** index: of COLOUR_BY, or SKIN. Counts from the next show() on. */
    colourBy(index) {
        this.colouredBy = index;
        for (const drawn of this.limbs) drawn.uniforms.uColourBy.value = Math.max(0, index);
    }
    setTheme(theme) {
        this.shared.uSky.value = rgb(theme.sky);
        this.shared.uEarth.value = rgb(theme.earth);
        this.shared.uBackground.value = rgb(theme.background);
        this.shared.uShade.value = rgb(theme.shade);
        this.bodyColour.value = rgb(theme.body);
    }
}
