(* SPDX-License-Identifier: MIT *)
(* Ranges in swivel_plane and frame_from_start. l is the wrist's exact length;
  everything is compared with it and with the
   size of the pole. *)
From Coq Require Import Reals Lra Psatz ZArith.
From Flocq Require Import Core.
From Swivel Require Import Rotors Products Wrist Rounding Near Turns Length.
Open Scope R_scope.

Lemma fl_most x : Rabs (fl32 x) <= 1.0000001 * Rabs x + 1e-45.
Proof.
  destruct (fl32_ok x) as [e [h [K [E Q]]]]. rewrite Q. unfold eta in E. eapply Rle_trans. apply Rabs_triang.
    rewrite Rabs_mult.
  apply ok_low in K. rewrite u_val in K. rewrite (Rabs_right (1 + e)) by lra. pose proof (Rabs_pos x).
  assert (Rabs x * (1 + e) <= Rabs x * 1.0000001) by (apply Rmult_le_compat_l; lra). lra.
Qed.
Lemma fl_between x : 0 <= x -> 0.9999999 * x - 1e-45 <= fl32 x <= 1.0000001 * x + 1e-45.
Proof.
  intro Hx. destruct (fl32_ok x) as [e [h [K [E Q]]]]. rewrite Q. unfold eta in E. apply Rabs_le_inv in E.
  apply ok_low in K. rewrite u_val in K.
  assert (x * (1 + e) <= x * 1.0000001) by (apply Rmult_le_compat_l; lra).
    assert (x * 0.9999999 <= x * (1 + e)) by (apply Rmult_le_compat_l; lra). lra.
Qed.
Lemma sqr_abs x : Rabs x * Rabs x = x * x.
Proof. unfold Rabs; destruct (Rcase_abs x); ring. Qed.
Lemma sqr_le_abs x y : 0 <= y -> x * x <= y * y -> Rabs x <= y.
Proof. intros Hy H. apply Rsqr_le_abs_0 in H. rewrite (Rabs_right y) in H; lra. Qed.
Lemma sqr_pos x : 0 <= x * x.
Proof. pose proof (Rle_0_sqr x) as Q. exact Q. Qed.
Lemma blur x y d : Rabs (y - x) <= d -> y * y <= 1.00001 * (x * x) + 100001 * (d * d).
Proof.
  intro H. apply sq_le in H. set (z := y - x) in *. replace y with (x + z) by (unfold z; ring).
  pose proof (sqr_pos (0.00001 * x - z)). lra.
Qed.
Lemma cauchy2 a b c d : (Rabs (a * c) + Rabs (b * d)) * (Rabs (a * c) + Rabs (b * d)) <= (a * a + b * b) * (c * c + d *
  d).
Proof.
  rewrite !Rabs_mult. rewrite <- (sqr_abs a), <- (sqr_abs b), <- (sqr_abs c), <- (sqr_abs d).
  pose proof (sqr_pos (Rabs a * Rabs d - Rabs b * Rabs c)). lra.
Qed.

Section Plane.
Variables w1 w2 w3 p1 p2 p3 : R.
Variables w11 w22 w12 w33 wrist2 length height : R.
Let l := sqrt (w1*w1 + w2*w2 + w3*w3).
Hypotheses (F3 : is_float w3) (G1 : is_float p1) (G2 : is_float p2) (G3 : is_float p3).
Hypotheses (X1 : w11 = fl32 (w1 * w1)) (X2 : w22 = fl32 (w2 * w2)) (X3 : w12 = fl32 (w11 + w22))
  (X4 : w33 = fl32 (w3 * w3)) (X5 : wrist2 = fl32 (w12 + w33)).
Hypotheses (X6 : length = fl32 (sqrt wrist2)) (X7 : height = fl32 (length + Rabs w3)).
Hypothesis Hw : 9.9e-10 <= wrist2.

Let l2 := w1*w1 + w2*w2 + w3*w3.
Lemma l_l : l * l = l2. Proof. unfold l, l2. apply sqrt_sqrt. pose proof (sqr_pos w1). pose proof (sqr_pos w2).
  pose proof (sqr_pos w3). lra. Qed.
Lemma wrist2_near : near 4e-7 wrist2 l2 /\ 9.8e-10 <= l2.
Proof.
  pose proof (sqr_pos w1). pose proof (sqr_pos w2). pose proof (sqr_pos w3).
  pose proof (fl_between (w1*w1) ltac:(lra)) as I1. pose proof (fl_between (w2*w2) ltac:(lra)) as I2.
    pose proof (fl_between (w3*w3) ltac:(lra)) as I4.
  assert (P1 : 0 <= w11) by (rewrite X1; apply fl_pos; lra). assert (P2 : 0 <= w22) by (rewrite X2; apply fl_pos; lra).
    assert (P4 : 0 <= w33) by (rewrite X4; apply fl_pos; lra).
  rewrite <- X1 in I1. rewrite <- X2 in I2. rewrite <- X4 in I4.
  pose proof (fl_between (w11 + w22) ltac:(lra)) as I3. assert (P3 : 0 <= w12) by (rewrite X3; apply fl_pos; lra).
    rewrite <- X3 in I3.
  pose proof (fl_between (w12 + w33) ltac:(lra)) as I5. rewrite <- X5 in I5.
  assert (9.8e-10 <= l2) by (unfold l2; lra). split; [|assumption]. apply near_intro. unfold l2 in *. lra.
Qed.
Lemma l_least : 3.1e-5 <= l.
Proof. destruct wrist2_near as [_ H]. unfold l. fold l2. rewrite <- (sqrt_square 3.1e-5) by lra. apply sqrt_le_1_alt.
  lra. Qed.
Lemma length_near : near 1.5e-7 length l.
Proof.
  pose proof l_least. pose proof (length_error w1 w2 w3 l w11 w22 w12 w33 wrist2 length ltac:(lra) l_l X1 X2 X3 X4 X5
    X6) as H0.
  unfold near. rewrite u_val in H0. lra.
Qed.
Lemma length_least : 3.09e-5 <= length. Proof. pose proof (near_bounds _ _ _ length_near). pose proof l_least. lra. Qed.
Lemma rel_height : relative (length + Rabs w3).
Proof. apply relative_sum. rewrite X6. apply float_fl. unfold is_float. now apply generic_format_abs. Qed.
Let H := l + Rabs w3.
Lemma w3_l : Rabs w3 <= l.
Proof. apply sqr_le_abs. pose proof l_least; lra. rewrite l_l. unfold l2. pose proof (sqr_pos w1).
  pose proof (sqr_pos w2). lra. Qed.
Lemma H_range : l <= H <= 2 * l.
Proof. pose proof w3_l. pose proof (Rabs_pos w3). unfold H. lra. Qed.
Lemma height_near : near 2.2e-7 height H.
Proof.
  pose proof l_least. pose proof (Rabs_pos w3). rewrite X7. apply near_fl with 1.5e-7; try (unfold H; lra).
    rewrite u_val; lra. apply rel_height.
  unfold H. apply near_add. apply length_near. apply near_weaken with 0; try lra. apply near_refl.
Qed.
Lemma middle_square : w1*w1 + w2*w2 + H*H = 2 * l * H.
Proof. unfold H. pose proof l_l as E. unfold l2 in E. pose proof (sqr_abs w3). lra. Qed.
Lemma lH : l2 <= l * H <= 2 * l2.
Proof. pose proof H_range. pose proof l_least. rewrite <- l_l. split. apply Rmult_le_compat_l; lra.
  replace (2 * (l*l)) with (l * (2*l)) by ring. apply Rmult_le_compat_l; lra. Qed.
Lemma flat_below : w1*w1 + w2*w2 <= 1.00001 * (height * height).
Proof.
  pose proof (near_bounds _ _ _ height_near). pose proof H_range. pose proof l_least.
  assert (0.999999 * l * (0.999999 * l) <= height * height) by (apply Rmult_le_compat; lra).
  assert (w1*w1 + w2*w2 <= l * l) by (rewrite l_l; unfold l2; pose proof (sqr_pos w3); lra). pose proof (sqr_pos l).
    lra.
Qed.

(* the middle line's squared length, halved *)
Variable middle : R.
Hypothesis Xmi : middle = fl32 (length * height).
Lemma rel_middle : relative (length * height).
Proof.
  apply relative_large. right. pose proof (near_bounds _ _ _ height_near). pose proof H_range. pose proof l_least.
    pose proof length_least.
  assert (3.09e-5 * 3e-5 <= length * height) by (apply Rmult_le_compat; lra). rewrite Rabs_right; lra.
Qed.
Lemma middle_near : near 4.5e-7 middle (l * H).
Proof.
  pose proof H_range. pose proof l_least. assert (0 <= l * H) by (apply Rmult_le_pos; lra).
  rewrite Xmi. apply near_fl with 3.8e-7; try lra. rewrite u_val; lra. apply rel_middle.
  apply near_mul with 1.5e-7 2.2e-7; try lra. apply length_near. apply height_near.
Qed.
Lemma middle_range : 9.7e-10 <= middle <= 2.00001 * wrist2.
Proof. pose proof (near_bounds _ _ _ middle_near). pose proof lH. destruct wrist2_near as [N' ?].
  apply near_bounds in N'. lra. Qed.

(* the pole *)
Variables p12 pole1 : R.
Hypotheses (Y1 : p12 = fl32 (Rabs p1 + Rabs p2)) (Y2 : pole1 = fl32 (p12 + Rabs p3)).
Hypotheses (Hp : 9.9e-10 <= pole1) (Hmost : wrist2 + pole1 <= 3.5001e7).
Let size := Rabs p1 + Rabs p2 + Rabs p3.
Lemma pole1_near : near 1.3e-7 pole1 size.
Proof.
  pose proof (Rabs_pos p1). pose proof (Rabs_pos p2). pose proof (Rabs_pos p3).
  assert (A : forall x, is_float x -> is_float (Rabs x)) by (intros x Fx; unfold is_float;
    now apply generic_format_abs).
  assert (N1 : near 6e-8 p12 (Rabs p1 + Rabs p2)).
  { rewrite Y1. apply near_fl with 0; try lra. rewrite u_val; lra. apply relative_sum; now apply A. apply near_refl. }
  rewrite Y2. unfold size. apply near_fl with 6e-8; try lra. rewrite u_val; lra. apply relative_sum.
    rewrite Y1; apply float_fl. now apply A.
  apply near_add. exact N1. apply near_weaken with 0; try lra. apply near_refl.
Qed.
Let q2 := p1*p1 + p2*p2 + p3*p3.
Lemma q2_most : 0 <= q2 <= 1.000001 * (pole1 * pole1).
Proof.
  unfold q2. pose proof (sqr_pos p1). pose proof (sqr_pos p2). pose proof (sqr_pos p3). split. lra.
  assert (q2 <= size * size).
  { unfold q2, size. rewrite <- (sqr_abs p1), <- (sqr_abs p2), <- (sqr_abs p3). pose proof (Rabs_pos p1).
    pose proof (Rabs_pos p2). pose proof (Rabs_pos p3).
    assert (0 <= Rabs p1 * Rabs p2) by now apply Rmult_le_pos.
      assert (0 <= Rabs p1 * Rabs p3) by now apply Rmult_le_pos.
      assert (0 <= Rabs p2 * Rabs p3) by now apply Rmult_le_pos. lra. }
  pose proof (near_bounds _ _ _ pole1_near). assert (0 <= size) by (unfold size; pose proof (Rabs_pos p1);
    pose proof (Rabs_pos p2); pose proof (Rabs_pos p3); lra).
  assert (0.9999998 * size * (0.9999998 * size) <= pole1 * pole1) by (apply Rmult_le_compat; lra). fold q2.
    pose proof (sqr_pos size). lra.
Qed.
(* V bounds every product of a component of the wrist with one of the pole *)
Let V := sqrt l2 * (1.000001 * pole1).
Lemma V_square : l2 * q2 <= V * V /\ V * V <= 1.0001 * (wrist2 * (pole1 * pole1)) /\ 2e-14 <= V.
Proof.
  destruct wrist2_near as [N' L]. apply near_bounds in N'. pose proof q2_most.
  assert (E : V * V = l2 * (1.000001 * 1.000001 * (pole1 * pole1))) by (unfold V;
    rewrite <- (sqrt_sqrt l2) at 3 by lra; ring). rewrite E.
  pose proof (sqr_pos pole1). repeat split.
  - apply Rmult_le_compat_l; lra.
  - assert (l2 * (pole1 * pole1) <= 1.000001 * wrist2 * (pole1 * pole1)) by (apply Rmult_le_compat_r; lra).
    assert (0 <= wrist2 * (pole1 * pole1)) by (apply Rmult_le_pos; lra). lra.
  - unfold V. pose proof l_least. change (sqrt l2) with l.
    assert (3.1e-5 * 9.9e-10 <= l * (1.000001 * pole1)) by (apply Rmult_le_compat; lra). lra.
Qed.
Lemma part_most a b : a * a <= l2 -> b * b <= q2 -> Rabs (b * a) <= V.
Proof.
  intros Ha Hb. destruct V_square as [Q [_ P]]. apply sqr_le_abs. lra. apply Rle_trans with (2 := Q).
  replace (b * a * (b * a)) with (a * a * (b * b)) by ring. apply Rmult_le_compat; try assumption; apply sqr_pos.
Qed.
Lemma cross_part a b c d x y z : a * a <= l2 -> c * c <= l2 -> b * b <= q2 -> d * d <= q2 ->
  x = fl32 (b * a) -> y = fl32 (d * c) -> z = fl32 (x - y) -> Rabs (z - (b * a - d * c)) <= 3e-7 * V.
Proof.
  intros Ha Hc Hb Hd X Y Z. pose proof (part_most a b Ha Hb) as B1. pose proof (part_most c d Hc Hd) as B2.
  assert (Y' : - y = fl32 (- (d * c))) by (rewrite Y; symmetry; apply fl_opp).
  pose proof (two_err32 _ _ _ _ _ X Y' Z) as T. rewrite Rabs_Ropp in T.
  replace (b * a + - (d * c)) with (b * a - d * c) in T by ring.
  assert (Rabs (b * a - d * c) <= 2 * V). { eapply Rle_trans. apply Rabs_triang. rewrite Rabs_Ropp. lra. }
  destruct V_square as [_ [_ P]].
  assert (K : k <= 6e-8) by (unfold k; rewrite u_val; lra). pose proof k0.
  assert (k * (Rabs (b * a) + Rabs (d * c) + Rabs (b * a - d * c)) <= 6e-8 * (4 * V)).
  { apply Rmult_le_compat; try lra. pose proof (Rabs_pos (b*a)). pose proof (Rabs_pos (d*c)).
    pose proof (Rabs_pos (b*a - d*c)). lra. }
  unfold eta in T. lra.
Qed.
Variables a1 a2 a3 a4 a5 a6 nx ny nz n11 n22 n12 n33 normal2 normal_length lp off : R.
Hypotheses (Z1 : a1 = fl32 (p2 * w1)) (Z2 : a2 = fl32 (p1 * w2)) (Z3 : nz = fl32 (a1 - a2)).
Hypotheses (Z4 : a3 = fl32 (p1 * w3)) (Z5 : a4 = fl32 (p3 * w1)) (Z6 : ny = fl32 (a3 - a4)).
Hypotheses (Z7 : a5 = fl32 (p3 * w2)) (Z8 : a6 = fl32 (p2 * w3)) (Z9 : nx = fl32 (a5 - a6)).
Hypotheses (U1 : n11 = fl32 (nx * nx)) (U2 : n22 = fl32 (ny * ny)) (U3 : n12 = fl32 (n11 + n22))
  (U4 : n33 = fl32 (nz * nz)) (U5 : normal2 = fl32 (n12 + n33)).
Hypotheses (U6 : normal_length = fl32 (sqrt normal2)).
Lemma parts : (w1*w1 <= l2 /\ w2*w2 <= l2 /\ w3*w3 <= l2) /\ (p1*p1 <= q2 /\ p2*p2 <= q2 /\ p3*p3 <= q2).
Proof. unfold l2, q2. pose proof (sqr_pos w1). pose proof (sqr_pos w2). pose proof (sqr_pos w3).
  pose proof (sqr_pos p1). pose proof (sqr_pos p2). pose proof (sqr_pos p3). lra. Qed.
Let n2 := nx*nx + ny*ny + nz*nz.
Lemma n2_most : n2 <= 1.0001 * (V * V).
Proof.
  destruct parts as [[? [? ?]] [? [? ?]]].
  pose proof (blur _ _ _ (cross_part w1 p2 w2 p1 a1 a2 nz ltac:(assumption) ltac:(assumption) ltac:(assumption)
    ltac:(assumption) Z1 Z2 Z3)) as C1.
  pose proof (blur _ _ _ (cross_part w3 p1 w1 p3 a3 a4 ny ltac:(assumption) ltac:(assumption) ltac:(assumption)
    ltac:(assumption) Z4 Z5 Z6)) as C2.
  pose proof (blur _ _ _ (cross_part w2 p3 w3 p2 a5 a6 nx ltac:(assumption) ltac:(assumption) ltac:(assumption)
    ltac:(assumption) Z7 Z8 Z9)) as C3.
  assert (L : (p2*w1 - p1*w2)*(p2*w1 - p1*w2) + (p1*w3 - p3*w1)*(p1*w3 - p3*w1) + (p3*w2 - p2*w3)*(p3*w2 - p2*w3) <= l2
    * q2).
  { unfold l2, q2. pose proof (sqr_pos (p1*w1 + p2*w2 + p3*w3)). lra. }
  destruct V_square as [Q _]. clear - C1 C2 C3 L Q. unfold n2. pose proof (sqr_pos V). lra.
Qed.
Lemma normal_most : 0 <= normal_length <= 1.001 * V.
Proof.
  pose proof n2_most as N'. destruct V_square as [_ [_ P]].
    assert (P2 : 4e-28 <= V * V) by (apply Rle_trans with (2e-14 * 2e-14); [lra|apply Rmult_le_compat; lra]).
  pose proof (sqr_pos nx). pose proof (sqr_pos ny). pose proof (sqr_pos nz).
  pose proof (fl_between (nx*nx) ltac:(lra)) as I1. pose proof (fl_between (ny*ny) ltac:(lra)) as I2.
    pose proof (fl_between (nz*nz) ltac:(lra)) as I4.
  assert (P1 : 0 <= n11) by (rewrite U1; apply fl_pos; lra). assert (Q2 : 0 <= n22) by (rewrite U2; apply fl_pos; lra).
    assert (P4 : 0 <= n33) by (rewrite U4; apply fl_pos; lra).
  rewrite <- U1 in I1. rewrite <- U2 in I2. rewrite <- U4 in I4.
  pose proof (fl_between (n11 + n22) ltac:(lra)) as I3. assert (P3 : 0 <= n12) by (rewrite U3; apply fl_pos; lra).
    rewrite <- U3 in I3.
  pose proof (fl_between (n12 + n33) ltac:(lra)) as I5. rewrite <- U5 in I5.
  assert (N3 : normal2 <= 1.0005 * 1.0005 * (V * V)) by (unfold n2 in N'; lra).
  assert (S : sqrt normal2 <= 1.0005 * V). { rewrite <- (sqrt_square (1.0005 * V)) by lra. apply sqrt_le_1_alt. lra. }
  pose proof (fl_between (sqrt normal2) (sqrt_pos _)) as I6. pose proof (fl_pos _ (sqrt_pos normal2)) as I7.
    rewrite <- U6 in I6, I7. lra.
Qed.

(* by `holds`: the pole is off the line *)
Hypotheses (O1 : lp = fl32 (length * pole1)) (O2 : off = fl32 (8589935 / 8589934592 * lp)) (O3 : off < normal_length).
Lemma normal_least : 9.99e-4 * (length * pole1) <= normal_length.
Proof.
  pose proof length_least. assert (M : 3e-14 <= length * pole1) by (apply Rle_trans with (3.09e-5 * 9.9e-10);
    [lra|apply Rmult_le_compat; lra]).
  pose proof (fl_between (length * pole1) ltac:(lra)) as I1. rewrite <- O1 in I1.
  pose proof (fl_between (8589935 / 8589934592 * lp) ltac:(lra)) as I2. rewrite <- O2 in I2. lra.
Qed.

(* the frame, scaled by the power of two *)
Variables per mx my mz along hx ax c hy ay s perl spread large : R.
Hypothesis Hper : 1/2 <= per * wrist2 <= 1.
Hypotheses (T1 : mx = fl32 (per * nx)) (T2 : my = fl32 (per * ny)) (T3 : mz = fl32 (per * nz))
  (T4 : along = mz \/ along = - mz).
Hypotheses (T5 : hx = fl32 (height * mx)) (T6 : ax = fl32 (along * w1)) (T7 : c = fl32 (ax - hx)).
Hypotheses (T8 : hy = fl32 (height * my)) (T9 : ay = fl32 (along * w2)) (T10 : s = fl32 (ay - hy)).
Hypotheses (S1 : perl = fl32 (per * normal_length)) (S2 : spread = fl32 (perl * height))
  (S3 : large = fl32 (spread + Rabs c)).
Lemma per_range : 0 < per /\ per * l2 <= 1.000001 /\ 0.4999 <= per * l2.
Proof.
  destruct wrist2_near as [N' L]. apply near_bounds in N'.
  assert (0 < per). { apply Rmult_lt_reg_r with wrist2; lra. }
  assert (per * wrist2 <= per * (1.0000004 * l2)) by (apply Rmult_le_compat_l; lra).
    assert (per * (0.9999996 * l2) <= per * wrist2) by (apply Rmult_le_compat_l; lra).
  repeat split; lra.
Qed.
Let m2 := mx*mx + my*my + mz*mz.
Lemma scaled_part x y : y = fl32 (per * x) -> y * y <= 1.00002 * (per * per * (x * x)) + 1e-80.
Proof.
  intro Y. destruct (fl32_ok (per * x)) as [e [h [K [E Q]]]]. rewrite <- Y in Q. unfold eta in E.
  assert (B : Rabs (y - per * x * (1 + e)) <= 1e-45) by (rewrite Q;
    replace (per * x * (1 + e) + h - per * x * (1 + e)) with h by ring; exact E).
  apply blur in B. apply ok_low in K. rewrite u_val in K. pose proof (sqr_pos (per * x)) as S.
  assert ((1 + e) * (1 + e) <= 1.0000001 * 1.0000001) by (apply Rmult_le_compat; lra).
  assert (per * x * (per * x) * ((1 + e) * (1 + e)) <= per * x * (per * x) * (1.0000001 * 1.0000001)) by (apply
    Rmult_le_compat_l; lra).
  replace (per * x * (1 + e) * (per * x * (1 + e))) with (per * x * (per * x) * ((1 + e) * (1 + e))) in B by ring.
  replace (per * per * (x * x)) with (per * x * (per * x)) by ring. lra.
Qed.
Lemma m2_most : m2 * l2 <= 1.001 * (pole1 * pole1).
Proof.
  pose proof (scaled_part _ _ T1) as C1. pose proof (scaled_part _ _ T2) as C2. pose proof (scaled_part _ _ T3) as C3.
  pose proof n2_most as N'. destruct per_range as [P [Q _]]. destruct wrist2_near as [W L]. apply near_bounds in W.
  assert (E : V * V = l2 * (1.000001 * 1.000001 * (pole1 * pole1))) by (unfold V;
    rewrite <- (sqrt_sqrt l2) at 3 by lra; ring).
  pose proof (sqr_pos per) as PP. pose proof (sqr_pos pole1) as Q1.
    assert (LQ : 0 <= l2 * (pole1 * pole1)) by (apply Rmult_le_pos; lra).
  assert (A : m2 <= 1.00002 * (per * per * n2) + 3e-80) by (unfold m2, n2; lra).
  assert (B : per * per * n2 <= per * per * (1.0002 * l2 * (pole1 * pole1))) by (apply Rmult_le_compat_l; lra).
  assert (C : per * l2 * (per * l2) <= 1.000001 * 1.000001) by (apply Rmult_le_compat; try lra; apply Rmult_le_pos;
    lra).
  assert (D : per * l2 * (per * l2) * (pole1 * pole1) <= 1.000001 * 1.000001 * (pole1 * pole1)) by (apply
    Rmult_le_compat_r; lra).
  assert (9e-19 <= pole1 * pole1) by (apply Rle_trans with (9.9e-10 * 9.9e-10); [lra|apply Rmult_le_compat; lra]).
  assert (A' : m2 * l2 <= (1.00002 * (per * per * (1.0002 * l2 * (pole1 * pole1))) + 3e-80) * l2) by (apply
    Rmult_le_compat_r; lra).
  replace ((1.00002 * (per * per * (1.0002 * l2 * (pole1 * pole1))) + 3e-80) * l2)
    with (1.00002 * 1.0002 * (per * l2 * (per * l2) * (pole1 * pole1)) + 3e-80 * l2) in A' by ring. lra.
Qed.
(* |along w| + |height m| in each of the two directions *)
Lemma turned_part w m : w * w <= w1*w1 + w2*w2 -> m*m + mz*mz <= m2 ->
  Rabs (along * w) + Rabs (height * m) <= 2.003 * pole1.
Proof.
  intros Hw' Hm. pose proof (cauchy2 along m w height) as C.
  rewrite (Rmult_comm m height) in C.
  set (y := Rabs (along * w) + Rabs (height * m)) in *.
  assert (Py : 0 <= y) by (unfold y; pose proof (Rabs_pos (along * w)); pose proof (Rabs_pos (height * m)); lra).
  assert (Ea : along * along = mz * mz) by (destruct T4 as [E|E]; rewrite E; ring). rewrite Ea in C.
  pose proof (near_bounds _ _ _ height_near) as NH. pose proof H_range as HR. pose proof l_least as LL.
    pose proof middle_square as MS. pose proof lH as LH.
  assert (h2 : height * height <= 1.0000003 * H * (1.0000003 * H)) by (apply Rmult_le_compat; lra).
  assert (wh : w * w + height * height <= 4.0001 * l2) by (pose proof (sqr_pos w1); pose proof (sqr_pos w2); lra).
  assert (B : (mz*mz + m*m) * (w*w + height*height) <= m2 * (4.0001 * l2)).
  { apply Rmult_le_compat; try lra; pose proof (sqr_pos mz); pose proof (sqr_pos m); pose proof (sqr_pos w);
    pose proof (sqr_pos height); lra. }
  pose proof m2_most as MM. pose proof (sqr_pos pole1).
  rewrite <- (Rabs_right y) by lra. apply sqr_le_abs. lra. lra.
Qed.
Lemma difference x y z X Y B : x = fl32 X -> y = fl32 Y -> z = fl32 (x - y) -> Rabs X + Rabs Y <= B -> 1e-12 <= B ->
  Rabs z <= 1.000001 * B.
Proof.
  intros Ex Ey Ez H0 HB. pose proof (fl_most X) as I1. pose proof (fl_most Y) as I2. rewrite <- Ex in I1.
    rewrite <- Ey in I2.
  pose proof (fl_most (x - y)) as I3. rewrite <- Ez in I3. pose proof (Rabs_triang x (- y)) as T.
    rewrite Rabs_Ropp in T. unfold Rminus in I3. lra.
Qed.
Lemma c_most : Rabs c <= 2.004 * pole1.
Proof.
  assert (A : Rabs (along * w1) + Rabs (height * mx) <= 2.003 * pole1) by (apply turned_part; unfold m2;
    [pose proof (sqr_pos w2)|pose proof (sqr_pos my)]; lra).
  pose proof (difference _ _ _ _ _ _ T6 T5 T7 A ltac:(lra)). lra.
Qed.
Lemma s_most : Rabs s <= 2.004 * pole1.
Proof.
  assert (A : Rabs (along * w2) + Rabs (height * my) <= 2.003 * pole1) by (apply turned_part; unfold m2;
    [pose proof (sqr_pos w1)|pose proof (sqr_pos mx)]; lra).
  pose proof (difference _ _ _ _ _ _ T9 T8 T10 A ltac:(lra)). lra.
Qed.
Lemma perl_range : 0.49 * (9.99e-4 * (length * pole1)) <= perl * l2 <= 1.0012 * V /\ 0 < perl.
Proof.
  destruct per_range as [P [Q1 Q2]]. pose proof normal_least as NL. destruct normal_most as [N0 NM].
    pose proof length_least. destruct wrist2_near as [W L]. apply near_bounds in W.
  assert (M : 3e-14 <= length * pole1) by (apply Rle_trans with (3.09e-5 * 9.9e-10); [lra|apply Rmult_le_compat; lra]).
  destruct V_square as [_ [_ PV]].
  pose proof (fl_between (per * normal_length) ltac:(apply Rmult_le_pos; lra)) as I. rewrite <- S1 in I.
  assert (A1 : per * l2 * normal_length <= 1.000001 * normal_length) by (apply Rmult_le_compat_r; lra).
  assert (A2 : 0.4999 * normal_length <= per * l2 * normal_length) by (apply Rmult_le_compat_r; lra).
  assert (A3 : perl * l2 <= (1.0000001 * (per * normal_length) + 1e-45) * l2) by (apply Rmult_le_compat_r; lra).
  assert (A4 : (0.9999999 * (per * normal_length) - 1e-45) * l2 <= perl * l2) by (apply Rmult_le_compat_r; lra).
  assert (A5 : 0.49 * (9.99e-4 * (length * pole1)) <= perl * l2) by lra.
  split. split; [exact A5|]. lra. apply Rmult_lt_reg_r with l2; lra.
Qed.
Lemma spread_range : 4.7e-4 * pole1 <= spread <= 2.003 * pole1.
Proof.
  destruct perl_range as [[P1 P2] P3]. pose proof (near_bounds _ _ _ height_near) as NH. pose proof H_range as HR.
    pose proof l_least as LL. pose proof (near_bounds _ _ _ length_near) as NL.
  destruct wrist2_near as [W L]. pose proof l_l as EL. assert (Pl : 0 < l) by lra.
  assert (HB : 0.999999 * l <= height <= 2.000001 * l) by lra.
  assert (PH : 0 <= perl * height) by (apply Rmult_le_pos; lra).
  pose proof (fl_between (perl * height) PH) as I. rewrite <- S2 in I.
  assert (VL : V = l * (1.000001 * pole1)) by reflexivity. rewrite VL in P2.
  assert (U1' : perl * height * l <= 2.0026 * pole1 * l).
  { assert (perl * l * height <= perl * l * (2.000001 * l)) by (apply Rmult_le_compat_l; [apply Rmult_le_pos|]; lra).
    replace (perl * l * (2.000001 * l)) with (2.000001 * (perl * (l * l))) in H0 by ring. rewrite EL in H0.
      assert (0 <= l * pole1) by (apply Rmult_le_pos; lra). lra. }
  apply Rmult_le_reg_r in U1'; [|exact Pl].
  assert (L1' : 4.8e-4 * pole1 * l <= perl * height * l).
  { assert (perl * l * (0.999999 * l) <= perl * l * height) by (apply Rmult_le_compat_l; [apply Rmult_le_pos|]; lra).
    replace (perl * l * (0.999999 * l)) with (0.999999 * (perl * (l * l))) in H0 by ring. rewrite EL in H0.
    assert (0.9999 * l * pole1 <= length * pole1) by (apply Rmult_le_compat_r; lra).
      assert (0 <= l * pole1) by (apply Rmult_le_pos; lra). lra. }
  apply Rmult_le_reg_r in L1'; [|exact Pl]. lra.
Qed.
Lemma large_range : 4.6e-4 * pole1 <= large <= 4.01 * pole1.
Proof.
  pose proof spread_range. pose proof c_most. pose proof (Rabs_pos c).
    pose proof (fl_between (spread + Rabs c) ltac:(lra)) as I. rewrite <- S3 in I. lra.
Qed.
Variables ss ll twist2 : R.
Hypotheses (R1 : ss = fl32 (s * s)) (R2 : ll = fl32 (large * large)) (R3 : twist2 = fl32 (ll + ss)).
Lemma large2 : 2e-7 * (pole1 * pole1) <= large * large <= 16.09 * (pole1 * pole1) /\ 9e-19 <= pole1 * pole1.
Proof.
  pose proof large_range. assert (9e-19 <= pole1 * pole1) by (apply Rle_trans with (9.9e-10 * 9.9e-10);
    [lra|apply Rmult_le_compat; lra]).
  assert (4.6e-4 * pole1 * (4.6e-4 * pole1) <= large * large) by (apply Rmult_le_compat; lra).
  assert (large * large <= 4.01 * pole1 * (4.01 * pole1)) by (apply Rmult_le_compat; lra). lra.
Qed.
Lemma twist2_near : near 1.193e-7 twist2 (large * large + s * s).
Proof.
  destruct large2 as [[A B] C]. pose proof (sqr_pos s) as PS.
  destruct (fl32_ok (s * s)) as [e1 [h1 [K1 [E1 Q1]]]]. destruct (fl32_ok (large * large)) as [e2 [h2 [K2 [E2 Q2]]]].
  assert (Rl : relative (ll + ss)) by (apply relative_sum; [rewrite R2|rewrite R1]; apply float_fl).
  rewrite R3. apply near_fl with 5.965e-8; try lra. rewrite u_val; lra. exact Rl.
  rewrite R1, R2, Q1, Q2. apply ok_low in K1. apply ok_low in K2. unfold eta in *. apply Rabs_le_inv in E1.
    apply Rabs_le_inv in E2. rewrite u_val in *.
  assert (s * s * (1 - 5.9604644775390625e-8) <= s * s * (1 + e1) <= s * s * (1 + 5.9604644775390625e-8)) by (split;
    apply Rmult_le_compat_l; lra).
  assert (large * large * (1 - 5.9604644775390625e-8) <= large * large * (1 + e2) <= large * large * (1 +
    5.9604644775390625e-8)) by (split; apply Rmult_le_compat_l; lra).
  apply near_intro. clear - H0 H1 E1 E2 A C PS. lra.
Qed.
Lemma twist2_range : 1.9e-7 * (pole1 * pole1) <= twist2 <= 20.3 * (pole1 * pole1).
Proof.
  destruct large2 as [[A B] C]. pose proof (near_bounds _ _ _ twist2_near). pose proof (sqr_pos s).
  assert (s * s <= 2.004 * pole1 * (2.004 * pole1)) by (apply sq_le, s_most). lra.
Qed.
End Plane.
