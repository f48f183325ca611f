// SPDX-License-Identifier: MIT
//
// The scene in metres: camera, ground, bodies. draw() shows it once; nothing here keeps drawing.
import {
    Color, GLSL3, Group, LinearSRGBColorSpace, Mesh, PerspectiveCamera, Scene, ShaderMaterial, Vector3, WebGLRenderer,
} from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";

import { Bodies } from "./bodies.js";
import { rgb, THEMES } from "./colours.js";
import { Ground } from "./ground.js";
import groundGlsl from "./ground.glsl";

const HEIGHT = 1.75;  // of a figure in the scene, metres
const NEARBY = 20;  // metres of the ground that the first picture is of
const FRONTAL = 0.42;  // radians: a square block is seen 21 degrees from the front

export class View {
    constructor(canvas, stage, figure) {
        this.stage = stage;
        this.figure = figure;
        this.metres = HEIGHT / figure.height;  // of the scene for a unit of the clip
        this.taller = 1;  // the skin than the skeleton
        this.middle = 0;  // the character that home() looked at
        this.followed = null;  // a character, or null
        this.covered = { right: 0, top: 0, bottom: 0 };  // pixels at the picture's sides that the page's parts cover
        this.renderer = new WebGLRenderer({ canvas, antialias: true });
        this.renderer.outputColorSpace = LinearSRGBColorSpace;  // the shaders' colours are the screen's own
        this.scene = new Scene();
        this.camera = new PerspectiveCamera(38, 1, 0.05, 2000);
        this.controls = new OrbitControls(this.camera, canvas);
        this.controls.maxPolarAngle = 0.497 * Math.PI;  // above level ground
        this.controls.minDistance = 0.4;
        this.controls.maxDistance = 400;
        this.relief = new Ground(stage, this.metres, figure.ground);
        this.bodies = new Bodies(stage, figure, this.metres, this.renderer.capabilities.maxTextureSize, this.relief.uniforms);
        this.addGround(this.relief.geometry, this.relief.uniforms.uHills.value);
        this.scene.add(...this.bodies.meshes);
        this.marks = new Group();  // what is drawn on top: handles and overlays, in units of the clip
        this.marks.scale.setScalar(this.metres);
        this.marks.position.y = -this.metres * figure.ground;
        this.scene.add(this.marks);
    }

    /** Arguments: as Bodies.addSkin() has them. */
    addSkin(skin, made) {
        this.bodies.addSkin(skin, made);
        this.taller = Math.max(1, made.height / this.figure.height);
        this.scene.add(...this.bodies.skins.meshes);
    }
    /** Level ground has no depth: shadows lie in it. */
    addGround(geometry, depthWrite) {
        const [vertexShader, fragmentShader] = groundGlsl.split("// ---- fragment");
        const { uFar, uBackground, uSun } = this.bodies.shared;
        const uniforms = { uGroundColour: { value: rgb("#ffffff") }, uLine: { value: rgb("#ffffff") }, uFar, uBackground, uSun };
        this.ground = new Mesh(geometry, new ShaderMaterial({ uniforms, glslVersion: GLSL3, vertexShader, fragmentShader, depthWrite }));
        this.ground.renderOrder = 0;
        this.scene.add(this.ground);
    }

    /**
     * Looks at the middle of the foremost row of those that are drawn. Figures mostly face +z. The camera looks along the
     * diagonal of the ground that they stand on nearby, less FRONTAL: at a block from in front, at a lone row along itself.
     */
    home(drawnCount) {
        const { characters } = this.stage, drawn = characters.slice(0, drawnCount);
        const front = Math.max(...drawn.map(({ place }) => place[2])), row = drawn.filter(({ place }) => place[2] === front);
        this.middle = characters.indexOf(row[row.length >> 1]);
        const [width, , depth] = [0, 1, 2].map((axis) => {
            const along = drawn.map(({ place }) => place[axis]);
            return Math.min(NEARBY, this.metres * (Math.max(...along) - Math.min(...along)));
        });
        const angle = Math.atan2(width + 1, depth + 1) - FRONTAL, distance = drawnCount > 1 ? 4.7 : 4;
        const offset = new Vector3(-distance * Math.sin(angle), 0.75 * HEIGHT, distance * Math.cos(angle));
        this.controls.target.copy(this.placeOf(this.middle, 0.55 * HEIGHT * this.taller));
        this.camera.position.copy(this.controls.target).addScaledVector(offset, this.farther());
        this.controls.update();
    }
    /** How much farther the camera must be for a figure to fit into what the page's parts leave free. */
    farther() {
        const { width, height } = this.size, { right, top, bottom } = this.covered;
        return this.taller * Math.min(3, Math.max(1, 0.85 * height / (height - top - bottom), 0.68 * height / (width - right)));
    }
    /** So many metres over where a character's first joint is on the ground. */
    placeOf(character, over = 0) {
        const { size, place } = this.stage.characters[character], root = this.figure.at(0, this.stage.clipFrame(character));
        root.applyQuaternion(this.stage.headingOf(character));
        const at = new Vector3(size * root.x + place[0], this.stage.lift(character), size * root.z + place[2]).multiplyScalar(this.metres);
        return at.setY(at.y + over);
    }
    /** A point of the clip's world in the scene. */
    toScene([x, y, z]) { return new Vector3(x, y - this.figure.ground, z).multiplyScalar(this.metres); }
    toClip({ x, y, z }) { return [x / this.metres, y / this.metres + this.figure.ground, z / this.metres]; }

    /** Looks at a character from where the camera is, at the same distance, or close by; in a jump, higher by as much. */
    lookAt(character, isClose) {
        const rise = this.figure.at(0, this.stage.clipFrame(character)).y - this.figure.at(0).y;
        const to = this.placeOf(character, 0.6 * HEIGHT + this.metres * rise), offset = this.camera.position.clone().sub(this.controls.target);
        if (isClose) offset.setLength(Math.min(offset.length(), 3.2 * this.farther()));
        this.controls.target.copy(to);
        this.camera.position.copy(to).add(offset);
        this.controls.update();
    }
    /** Goes back until all of these points of the clip's world are seen, or far enough. */
    makeSeen(points) {
        for (let tries = 0; tries < 8 && !points.every((point) => this.isSeen(point)); ++tries) this.recede(1.15);
    }
    /** Makes the distance to what is looked at so many times as large. */
    recede(factor) {
        const { target } = this.controls;
        this.camera.position.sub(target).multiplyScalar(factor).add(target);
        this.controls.update();
    }
    /** Whether a point of the clip's world is in the part of the picture that is free. */
    isSeen(world) {
        const at = this.project(world), box = this.renderer.domElement.getBoundingClientRect(), { right, top, bottom } = this.covered;
        return at !== null && at.x > box.left && at.x < box.right - right && at.y > box.top + top && at.y < box.bottom - bottom;
    }
    /** Follows a character, or nobody if it is null. */
    follow(character) {
        this.followed = character;
        this.followedAt = character === null ? null : this.placeOf(character);
    }
    /** After a change of the ground: stays where it is. */
    stay() { this.follow(this.followed); }
    /** After a change of the frame: goes along with whom it follows. */
    moveAlong() {
        if (this.followed === null) return;
        const at = this.placeOf(this.followed), step = at.clone().sub(this.followedAt);
        this.camera.position.add(step);
        this.controls.target.add(step);
        this.followedAt = at;
    }

    setTheme(name) {
        const theme = THEMES[name];
        this.scene.background = new Color().copy(rgb(theme.background));
        this.bodies.setTheme(theme);
        this.ground.material.uniforms.uGroundColour.value = rgb(theme.ground);
        this.ground.material.uniforms.uLine.value = rgb(theme.line);
    }
    /** right, top, bottom: pixels that the page's parts cover there; what is looked at is in the middle of the rest. */
    resize(width, height, right, top, bottom) {
        this.size = { width, height };
        this.covered = { right, top, bottom };
        this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
        this.renderer.setSize(width, height, false);
        this.camera.aspect = width / height;
        this.camera.setViewOffset(width, height, right / 2, (bottom - top) / 2, width, height);
    }
    draw() {
        const distance = this.camera.position.distanceTo(this.controls.target);
        this.bodies.shared.uFar.value = Math.max(45, 6 * distance);
        this.bodies.pose();
        this.relief.update();
        this.renderer.render(this.scene, this.camera);
    }
    /** Pixels on the page of a point of the clip's world; null behind the camera. */
    project(world) {
        return this.projectScene(this.toScene(world));
    }
    projectScene(point) {
        this.camera.updateMatrixWorld();
        const at = point.project(this.camera), box = this.renderer.domElement.getBoundingClientRect();
        if (at.z > 1) return null;
        return { x: box.left + (at.x + 1) / 2 * box.width, y: box.top + (1 - at.y) / 2 * box.height };
    }
}
