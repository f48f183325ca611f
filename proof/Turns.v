(* SPDX-License-Identifier: MIT *)
(* The two quaternion products and the scale, rounded to binary32. Where the quaternions are longer than 1e-30, the
   bounds of the errors cover underflow, too. *)
From Coq Require Import Reals Lra Psatz ZArith.
From Swivel Require Import Rotors Products Elbow Wrist Rounding.
Open Scope R_scope.

Lemma clip e a t : 0 <= a -> 0 <= t -> Rabs e <= a + t -> exists e1, Rabs e1 <= a /\ Rabs (e - e1) <= t.
Proof.
  intros Ha Ht H. destruct (Rle_dec (Rabs e) a) as [L|L].
  - exists e. split. exact L. rewrite Rminus_diag_eq, Rabs_R0; lra.
  - unfold Rabs in H, L. destruct (Rcase_abs e).
    + exists (-a). split; apply Rabs_le; lra.
    + exists a. split; apply Rabs_le; lra.
Qed.
Lemma q2n_split E E1 : q2n E <= 1.00001 * q2n E1 + 100001 * q2n (qsub E E1).
Proof.
  assert (C : forall x y, x*x <= 1.00001*(y*y) + 100001*((x-y)*(x-y))).
  { intros x y. set (z := x - y). replace x with (y + z) by (unfold z; ring).
    pose proof (Rle_0_sqr (0.00001*y - z)) as Q. unfold Rsqr in Q. nra. }
  unfold q2n, qsub; simpl. pose proof (C (qw E) (qw E1)). pose proof (C (qx E) (qx E1)). pose proof (C (qy E) (qy E1)).
    pose proof (C (qz E) (qz E1)). lra.
Qed.
Lemma small_q E t : 0 <= t -> Rabs (qw E) <= t -> Rabs (qx E) <= t -> Rabs (qy E) <= t -> Rabs (qz E) <= t ->
  q2n E <= 4*(t*t).
Proof. intros Ht A B C D. apply sq_le in A. apply sq_le in B. apply sq_le in C. apply sq_le in D. unfold q2n. lra. Qed.

Lemma two_err32 A B x y z : x = fl32 A -> y = fl32 B -> z = fl32 (x + y) ->
  Rabs (z - (A + B)) <= k * (Rabs A + Rabs B + Rabs (A + B)) + 4 * eta.
Proof.
  intros X Y Z. destruct (fl32_ok A) as [a [ha [Ka [Ea Qa]]]]. destruct (fl32_ok B) as [b [hb [Kb [Eb Qb]]]].
    destruct (fl32_ok (x + y)) as [c [hc [Kc [Ec Qc]]]].
  rewrite Qc in Z. rewrite Qa in X. rewrite Qb in Y.
  replace (z - (A + B)) with ((two A B a b c - (A + B)) + ((ha + hb) * (1 + c) + hc)) by (rewrite Z, X, Y; unfold two;
    ring).
  eapply Rle_trans. apply Rabs_triang. apply Rplus_le_compat. apply two_err; assumption.
  eapply Rle_trans. apply Rabs_triang. rewrite Rabs_mult.
  assert (Rabs (ha + hb) <= 2*eta) by (eapply Rle_trans; [apply Rabs_triang|lra]).
  pose proof (ok_low _ Kc) as O. pose proof u_val. rewrite (Rabs_right (1+c)) by lra.
  assert (0 <= eta) by (unfold eta; lra).
  assert (Rabs (ha+hb) * (1+c) <= 2*eta*1.1). { apply Rmult_le_compat; try lra. apply Rabs_pos. } lra.
Qed.
Lemma one_err32 A : Rabs (fl32 A - A) <= k * Rabs A + 4 * eta.
Proof. destruct (fl32_ok A) as [a [ha [Ka [Ea Qa]]]]. rewrite Qa.
  replace (A*(1+a)+ha - A) with ((A*(1+a) - A) + ha) by ring.
  eapply Rle_trans. apply Rabs_triang. assert (0 <= eta) by (unfold eta; lra). pose proof (one_err A a Ka). lra. Qed.

Lemma kk : 3.55e-15 <= k*k. Proof. unfold k. rewrite u_val. lra. Qed.
Lemma k0 : 0 <= k. Proof. unfold k. rewrite u_val. lra. Qed.

(* The middle line times the twist. *)
Theorem twist_product w1 w2 h t0 t3 y1 y2 gx y3 y4 gy gz gw :
  w1*w1 + w2*w2 <= 1.00001 * (h*h) ->
  y1 = fl32 (w1 * t0) -> y2 = fl32 (w2 * t3) -> gx = fl32 (y1 + y2) ->
  y3 = fl32 (w2 * t0) -> y4 = fl32 (w1 * t3) -> gy = fl32 (y3 - y4) ->
  gz = fl32 (h * t0) -> gw = fl32 (- (h * t3)) ->
  let mt := qmul (q4 0 w1 w2 h) (q4 t0 0 0 t3) in 1e-60 <= q2n mt ->
  q2n (qsub (q4 gw gx gy gz) mt) <= (1.8482*k)*(1.8482*k) * q2n mt.
Proof.
  intros Hh Y1 Y2 Y3 Y4 Y5 Y6 Y7 Y8 mt Hm.
  assert (T : 0 <= 4*eta) by (unfold eta; lra). pose proof k0 as Pk.
  assert (Y5' : - y4 = fl32 (- (w1*t3))) by (rewrite Y5; apply eq_sym, fl_opp).
  pose proof (two_err32 _ _ _ _ _ Y1 Y2 Y3) as Bx. pose proof (two_err32 _ _ _ _ _ Y4 Y5' Y6) as By.
  pose proof (one_err32 (h*t0)) as Bz. pose proof (one_err32 (-(h*t3))) as Bw. rewrite <- Y7 in Bz. rewrite <- Y8 in Bw.
  rewrite !Rabs_Ropp in *.
  assert (PP : forall a b, 0 <= k * (Rabs a + Rabs b + Rabs (a + b))) by (intros; apply Rmult_le_pos;
    [exact Pk|pose proof (Rabs_pos a); pose proof (Rabs_pos b); pose proof (Rabs_pos (a+b)); lra]).
  assert (P1 : forall a, 0 <= k * Rabs a) by (intros; apply Rmult_le_pos; [exact Pk|apply Rabs_pos]).
  apply clip in Bx; [|apply PP|exact T]. apply clip in By; [|rewrite <- (Rabs_Ropp (w1*t3)); apply PP|exact T].
    apply clip in Bz; [|apply P1|exact T]. apply clip in Bw; [|apply P1|exact T].
  destruct Bx as [ex [X1 X2]]. destruct By as [ey [Z1 Z2]]. destruct Bz as [ez [U1 U2]]. destruct Bw as [ew [V1 V2]].
  set (E := qsub (q4 gw gx gy gz) mt). set (E1 := q4 ew ex ey ez).
  assert (S1 : q2n E1 <= 3.4151 * (k*k) * q2n mt).
  { replace (q2n mt) with (q2n (q4 0 w1 w2 h) * (t0*t0+t3*t3)). apply twist_err; try assumption.
    unfold mt. rewrite q2n_mul. f_equal. unfold q2n; simpl; ring. }
  assert (S2 : q2n (qsub E E1) <= 4*((4*eta)*(4*eta))).
  { apply small_q; [exact T|..]; unfold E, E1, mt, qsub, qmul; cbn [qw qx qy qz].
    - replace (gw - (0*t0 - w1*0 - w2*0 - h*t3) - ew) with (gw - - (h*t3) - ew) by ring. exact V2.
    - replace (gx - (0*0 + w1*t0 + w2*t3 - h*0) - ex) with (gx - (w1*t0 + w2*t3) - ex) by ring. exact X2.
    - replace (gy - (0*0 - w1*t3 + w2*t0 + h*0) - ey) with (gy - (w2*t0 + - (w1*t3)) - ey) by ring. exact Z2.
    - replace (gz - (0*t3 + w1*0 - w2*0 + h*t0) - ez) with (gz - h*t0 - ez) by ring. exact U2. }
  pose proof (q2n_split E E1) as SP. pose proof kk as KK. unfold eta in S2.
  set (Q := q2n mt) in *.
  assert (A1 : 3.55e-15*Q <= k*k*Q) by (apply Rmult_le_compat_r; lra).
  replace (1.8482*k*(1.8482*k)*Q) with (1.8482*1.8482*(k*k*Q)) by ring.
  replace (3.4151*(k*k)*Q) with (3.4151*(k*k*Q)) in S1 by ring. set (Z := k*k*Q) in *. clearbody Z.
  lra.
Qed.
Theorem lift_product g l0 l1 v1 v2 gw2 v3 v4 gx2 v5 v6 gy2 v7 v8 gz2 :
  v1 = fl32 (qw g * l0) -> v2 = fl32 (qx g * l1) -> gw2 = fl32 (v1 - v2) ->
  v3 = fl32 (qx g * l0) -> v4 = fl32 (qw g * l1) -> gx2 = fl32 (v3 + v4) ->
  v5 = fl32 (qy g * l0) -> v6 = fl32 (qz g * l1) -> gy2 = fl32 (v5 + v6) ->
  v7 = fl32 (qz g * l0) -> v8 = fl32 (qy g * l1) -> gz2 = fl32 (v7 - v8) ->
  let gl := qmul g (q4 l0 l1 0 0) in 1e-60 <= q2n gl ->
  q2n (qsub (q4 gw2 gx2 gy2 gz2) gl) <= (2.4147*k)*(2.4147*k) * q2n gl.
Proof.
  intros V1 V2 V3 V4 V5 V6 V7 V8 V9 V10 V11 V12 gl Hm.
  assert (T : 0 <= 4*eta) by (unfold eta; lra). pose proof k0 as Pk.
  assert (V2' : - v2 = fl32 (- (qx g * l1))) by (rewrite V2; apply eq_sym, fl_opp).
  assert (V11' : - v8 = fl32 (- (qy g * l1))) by (rewrite V11; apply eq_sym, fl_opp).
  pose proof (two_err32 _ _ _ _ _ V1 V2' V3) as Bw. pose proof (two_err32 _ _ _ _ _ V4 V5 V6) as Bx.
  pose proof (two_err32 _ _ _ _ _ V7 V8 V9) as By. pose proof (two_err32 _ _ _ _ _ V10 V11' V12) as Bz.
  assert (PP : forall a b, 0 <= k * (Rabs a + Rabs b + Rabs (a + b))) by (intros; apply Rmult_le_pos;
    [exact Pk|pose proof (Rabs_pos a); pose proof (Rabs_pos b); pose proof (Rabs_pos (a+b)); lra]).
  apply clip in Bx; [|apply PP|exact T]. apply clip in By; [|apply PP|exact T]. apply clip in Bz; [|apply PP|exact T].
    apply clip in Bw; [|apply PP|exact T].
  destruct Bx as [ex [X1 X2]]. destruct By as [ey [Z1 Z2]]. destruct Bz as [ez [U1 U2]]. destruct Bw as [ew [W1 W2]].
  rewrite Rabs_Ropp in U1, W1.
  set (E := qsub (q4 gw2 gx2 gy2 gz2) gl). set (E1 := q4 ew ex ey ez).
  assert (S1 : q2n E1 <= 5.83 * (k*k) * q2n gl).
  { replace (q2n gl) with (q2n g * (l0*l0+l1*l1)). apply lift_err; assumption.
    unfold gl. rewrite q2n_mul. f_equal. unfold q2n; simpl; ring. }
  assert (S2 : q2n (qsub E E1) <= 4*((4*eta)*(4*eta))).
  { apply small_q; [exact T|..]; unfold E, E1, gl, qsub, qmul; cbn [qw qx qy qz].
    - replace (gw2 - (qw g*l0 - qx g*l1 - qy g*0 - qz g*0) - ew) with (gw2 - (qw g*l0 + - (qx g*l1)) - ew) by ring.
      exact W2.
    - replace (gx2 - (qw g*l1 + qx g*l0 + qy g*0 - qz g*0) - ex) with (gx2 - (qx g*l0 + qw g*l1) - ex) by ring.
      exact X2.
    - replace (gy2 - (qw g*0 - qx g*0 + qy g*l0 + qz g*l1) - ey) with (gy2 - (qy g*l0 + qz g*l1) - ey) by ring.
      exact Z2.
    - replace (gz2 - (qw g*0 + qx g*0 - qy g*l1 + qz g*l0) - ez) with (gz2 - (qz g*l0 + - (qy g*l1)) - ez) by ring.
      exact U2. }
  pose proof (q2n_split E E1) as SP. pose proof kk as KK. unfold eta in S2. set (Q := q2n gl) in *.
  assert (A1 : 3.55e-15*Q <= k*k*Q) by (apply Rmult_le_compat_r; lra).
  replace (2.4147*k*(2.4147*k)*Q) with (2.4147*2.4147*(k*k*Q)) by ring.
  replace (5.83*(k*k)*Q) with (5.83*(k*k*Q)) in S1 by ring. set (Z := k*k*Q) in *. clearbody Z. lra.
Qed.

Theorem scaled kap g2 q0 q1 q2 q3 :
  q0 = fl32 (kap * qw g2) -> q1 = fl32 (kap * qx g2) -> q2 = fl32 (kap * qy g2) -> q3 = fl32 (kap * qz g2) ->
  1e-60 <= q2n (qscale kap g2) ->
  q2n (qsub (q4 q0 q1 q2 q3) (qscale kap g2)) <= (1.001*u)*(1.001*u) * q2n (qscale kap g2).
Proof.
  intros Q0 Q1 Q2 Q3 Hm.
  assert (C : forall x, (fl32 x - x)*(fl32 x - x) <= 1.00001*(u*u*(x*x)) + 100001*(eta*eta)).
  { intro x. destruct (fl32_ok x) as [a [h [Ka [Eh Q]]]]. rewrite Q. replace (x*(1+a)+h - x) with (x*a + h) by ring.
    unfold ok in Ka. apply sq_le in Ka. apply sq_le in Eh.
    assert (D : (x*a+h)*(x*a+h) <= 1.00001*(x*a*(x*a)) + 100001*(h*h)) by (pose proof (Rle_0_sqr (0.00001*(x*a) - h))
      as S; unfold Rsqr in S; nra).
    assert (x*x*(a*a) <= x*x*(u*u)) by (apply Rmult_le_compat_l; [apply Rle_0_sqr|exact Ka]).
    replace (x*a*(x*a)) with (x*x*(a*a)) in D by ring. lra. }
  pose proof (C (kap*qw g2)) as C0. pose proof (C (kap*qx g2)) as C1. pose proof (C (kap*qy g2)) as C2.
    pose proof (C (kap*qz g2)) as C3.
  rewrite <- Q0 in C0. rewrite <- Q1 in C1. rewrite <- Q2 in C2. rewrite <- Q3 in C3.
  unfold qsub, qscale, q2n in *; cbn [qw qx qy qz] in *. unfold eta in *. rewrite u_val in *. lra.
Qed.
